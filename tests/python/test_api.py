# SPDX-License-Identifier: MIT
"""Every public name of C++ has one in Python, or a reason why it has none."""

import inspect
import re

import pytest
from conftest import ROOT

import carom

RENAMED = {
    "LastingContact": "PersistentContact",  # the field's word
    "lastingContacts": "Motion.contacts",
    "StateSeed": "Seed",
    "Document": "Scene",
    "readDocument": "Scene.read",
    "parseDocument": "Scene.__init__",
    "writeDocument": "Scene.to_text",
    "saveDocument": "Scene.write",
    "FileRepair": "Scene.repairs",
    "SceneDerivative": "SceneGradient",
    "exportMotion": "Motion.export",
    "motionText": "Motion.text",
    "csvText": "Motion.text",
    "svgText": "Motion.text",
    "gltfText": "Motion.text",
    "blenderText": "Motion.text",
    "Margins": "Event.grazing",
    "Participant": "Event.bodies",
    "PairCoefficients": "Contact.friction",
    "ContactPoint": "Contact.point",
    "FeaturePair": "Contact.features",
    "describeOverlap": "StartOverlap.__str__",
    "MotionFunction": "Edit.require",
    "RowReading": "Reading",
    "Hit": "Edit.hit",
    "Grip": "EditSession.grab",
    "NailTargets": "EditSession.nail",
    "NailId": "NailState.id",
    "NailAt": "EditSession.release_nailed",
    "AlsoVary": "EditSession.grab",
    "MeasureFrom": "EditSession.__init__",
    "SessionOptions": "EditSession.__init__",
    "SessionObstacle": "SessionUpdate.obstacle",
    "sessionNumbers": "EditSession.numbers",
    "documentOf": "EditSession.scene",
    "saveJournal": "EditSession.write_journal",
    "readJournal": "SessionReplay.read",
    "SessionContent": "EditSession.set_content",
    "SimulateOptions": "simulate",
    "EditOptions": "Edit.solve",
    "Effort": "Edit.solve",
    "SequencePolicy": "Edit.solve",
    "SecondDerivatives": "Edit.solve",
    "ExportOptions": "Motion.export",
    "GltfOptions": "Motion.export",
    "Instant": "Seed",
    "SceneGradient": "SceneGradient",
    "importGltf": "import_gltf",
    "Imported": "import_gltf",
    "ImportOptions": "import_gltf",
    "nthImpact": "nth_impact",
    "atRest": "at_rest",
    "atLeast": "at_least",
    "atMost": "at_most",
    "SeedRates": "second_order",  # its argument seed_rates
}

WORDS = "an enumeration: its words are texts in Python"
DICT = "scenes are written as documents: a dict has it"
CONTACTS = "the interface of collision detection, for sources written in C++"
INSIDE = "of the integrator and its derivatives; a motion is read by states"
JOURNAL = "a journal is a file in Python: EditSession.write_journal, SessionReplay.read"
HISTORY = "for programs that resume a session with its undo steps: the studio; in Python a journal is replayed"
SNAPSHOT = "what sessions look for in the background is of the studio so far"
CHEAP = "for C++ programs that draw or read by themselves"
CONSTANT = "a constant that the page or the docstring says"
LEFT_OUT = {
    **dict.fromkeys(["EditStatus", "EventKind", "ImpactMode", "MotionStatus", "TransitionCause", "SessionStage", "ArcKind",
                     "Tier", "Law", "GltfKeys", "nameOf", "branchOf"], WORDS),
    **dict.fromkeys(["Body", "Material", "Inertia", "Tilt", "CollisionFilter", "Combine", "Shape", "Sphere", "Box", "Plane",
                     "Capsule", "Cylinder", "Cone", "Hull", "Mesh", "Compound", "CompoundPart", "Surface", "Target",
                     "Constraint", "validate", "nailConstraint", "Distribution", "NormalDistribution", "LogNormalDistribution",
                     "UniformDistribution", "UniformOrientation"], DICT),
    **dict.fromkeys(["ContactSource", "ContactGeometry", "ContactJacobian", "ContactMotion", "PairTangent", "PlacedContact",
                     "PersistentFeatures", "PredictedImpact", "kSearchedSoFar", "OdeContacts", "Pose", "PoseRate", "WorkCount",
                     "WorkEnded", "BodyGeometry", "FeatureLimit", "mayCollide"], CONTACTS),
    **dict.fromkeys(["Arc", "State", "StateDerivative", "Kinematics", "BodyModel", "BodyModelDerivative", "BodyDerivative",
                     "MaterialDerivative", "RotationSensitivity", "ArcSensitivity", "DerivativeTape", "WorldLine", "BodyPlan",
                     "Plan", "Asked", "makePlan", "lawOf", "combine", "modelOf", "modelTangent", "modelPullback",
                     "startState", "startTangent", "startPullback", "centerOfMass", "centerOfMassRates", "toBodyState",
                     "flightTangent", "flightPullback", "chained", "turned", "isZero", "SolidProperties", "SolidRate",
                     "ShapeKind", "shapeKinds", "kindOf", "FarthestPoint", "FarthestFrom", "farthestFrom"], INSIDE),
    **dict.fromkeys(["Free", "TargetNumber", "WantedVector", "targetOf"], "numbers and None of a nail do it"),
    **dict.fromkeys(["SessionJournal", "SessionGesture", "DragTarget", "JournalDocument", "parseJournal", "writeJournal",
                     "replayJson"], JOURNAL),
    **dict.fromkeys(["SessionHistory", "SessionHistoryNail", "SessionHistoryPoint"], HISTORY),
    **dict.fromkeys(["SessionSnapshot", "SessionRemedy", "SessionWhyNot", "whyNot", "SessionAlternatives",
                     "alternativesTo"], SNAPSHOT),
    **dict.fromkeys(["bodyIndex", "materialIndex", "materialIndexOf", "materialOf"], "Scene.bodies.index does it"),
    **dict.fromkeys(["DisplayMesh", "DisplayTrack", "displayMesh", "displayTrack",
                     "TriangleSoup", "readMeshFile", "readPointsFile", "meshSurface", "assembleSurface", "convexHull",
                     "parseGltfScene", "writeDocumentIn", "saveWithMeshes", "exportExtensions", "lastFrame",
                     "describeOverlapAtStart", "refuseOverlap", "describeChanges", "sequenceChanges",
                     "wholeSequenceChanges", "nailStateIn"], CHEAP),
    **dict.fromkeys(["Vec2", "Vec3", "Mat3", "Quat", "skew", "unskew"], "NumPy's arrays"),
    **dict.fromkeys(["MotionAlong", "simulateAlong"], "along a given sequence: of the solver's inside so far"),
    "RatesWanted": "an option of speed: Python gives all rates",
    "EditAbandoned": "Ctrl-C, and what a callback raises, abandon an edit: that comes out of Edit.solve",
    "any": "None",
    **dict.fromkeys(["Seconds", "TimeSpan"], "a float, and two of them"),
    "setSolverLibrary": "the package names its own",
}

# Members of classes, and fields of options that are arguments in Python: under which name, or why there is none.
GIVEN = "what was given, which the caller has"
LISTS = "Event.contacts and Event.bodies are lists, to be searched"
CALLS = "called after every impact: a C++ program would wait for Python; `progress` stops a simulation"
SPEED = "an option of speed alone"
RELIABLE = "EditResult.reliability says it, of the worst row"
ALWAYS = "Ctrl-C, and what a callback raises, always abandon an edit"
REASONS = {ALWAYS, SNAPSHOT, GIVEN, LISTS, CALLS, SPEED, RELIABLE, INSIDE, CONTACTS, DICT, HISTORY}
CLASSES = {
    "Motion": ("adjoint/motion/motion.h", "Motion", {
        "stateAt": "state_at", "modelOf": INSIDE, "impacts": "impacts", "taken_over": INSIDE, "plan": INSIDE, "models": INSIDE, "geometry": CONTACTS,
        "world_lines": INSIDE, "arcAt": INSIDE, "describeEvent": "events"}),
    "Event": ("adjoint/motion/motion.h", "Event", {
        "border": INSIDE, "participants": "bodies", "margins": "grazing", "find": LISTS, "touches": LISTS, "meets": LISTS}),
    "Contact": ("adjoint/motion/motion.h", "Contact", {
        "a": "bodies", "b": "bodies", "at": "point", "tilt_a": INSIDE, "tilt_b": INSIDE, "pair": "friction", "kept": INSIDE}),
    "Nail": ("editing/nail.h", "Nail", {}),
    "Edit": ("editing/edit.h", "Edit", {"constraints": DICT}),
    "NlpEvaluator": ("editing/nlp_evaluator.h", "NlpEvaluator", {}),
    "NlpPoint": ("editing/nlp_evaluator.h", "NlpPoint", {}),
    "NlpVariable": ("editing/nlp_evaluator.h", "NlpVariable", {}),
    "NlpRow": ("editing/nlp_evaluator.h", "NlpRow", {}),
    "MotionFunctionCheck": ("editing/check_motion_function.h", "MotionFunctionCheck", {}),
    "RowReading": ("editing/motion_function.h", "Reading", {"seed_rates": GIVEN}),
    "SecondOrder": ("adjoint/second_order/second_order.h", "SecondOrder", {}),
    "BodyStateRate": ("adjoint/derivative/tangent.h", "BodyStateRate", {}),
    "EditResult": ("editing/edit_result.h", "EditResult", {}),
    "Certificate": ("editing/certificate.h", "Certificate", {"reliability": RELIABLE}),
    "EditSession": ("editing/session.h", "EditSession", {
        "constraints": "scene", "constraintOf": "scene", "nailStates": "nails", "content": "scene",
        "options": GIVEN,
        "history": HISTORY, "snapshot": SNAPSHOT, "keepSequence": SNAPSHOT, "journal": "write_journal"}),
    "SessionReplay": ("editing/session_replay.h", "SessionReplay", {"next": "__next__", "session": "scene"}),
    "ReplayedGesture": ("editing/session_replay.h", "ReplayedGesture", {}),
    "NailState": ("editing/session.h", "NailState", {}),
    "SessionNumber": ("editing/session_numbers.h", "SessionNumber", {}),
    "SessionUpdate": ("editing/session_update.h", "SessionUpdate", {"scene": "motion"}),
    "MotionTangent": ("adjoint/derivative/tangent.h", "MotionTangent", {"start": INSIDE, "model": INSIDE}),
    "Reliability": ("adjoint/derivative/derivative_tape.h", "Reliability", {
        "frictions": "unreliable_for", "beginning": "unreliable_for", "seams": "unreliable_for",
        "friction_message": "sentences", "beginning_message": "sentences", "seam_message": "sentences", "pass": INSIDE,
        "passFriction": INSIDE, "passArc": INSIDE, "askFriction": INSIDE, "askVelocity": INSIDE, "askSpin": INSIDE,
        "askPlace": INSIDE, "surfaces": INSIDE, "surface_message": INSIDE, "askSurface": INSIDE}),
    "SimulateOptions": ("adjoint/simulate/simulate.h", "simulate", {
        "asked": INSIDE, "stop": "progress", "stop_when": CALLS, "least_duration": CALLS, "baseline": SPEED, "given": CONTACTS}),
    "EditOptions": ("editing/edit_options.h", "Edit.solve", {
        "time_budget_seconds": "time_budget", "stop": "progress", "abandon": ALWAYS}),
    "Control": ("editing/control.h", "Control", {
        "notes": DICT, "distribution": DICT, "within": "min", "atLeast": "min", "atMost": "max", "only": "components", "weighted": "weight"}),
}


def snake(name):
    return re.sub(r"(?<=[a-z])([A-Z])", r"_\1", name).lower()


def public_headers():
    for folder in ("adjoint", "ode_bridge", "editing", "formats"):
        yield from sorted((ROOT / folder).rglob("*.h"))


def names_of(text):
    """Types, functions and constants directly in namespace carom: the sources are formatted."""
    spaces, names = [], []
    text = re.sub(r"^namespace \w+ \{\n(?:(?:struct|class) \w+;.*\n)+\}.*\n", "", text, flags=re.MULTILINE)  # declared only
    for line in text.splitlines():
        if match := re.match(r"namespace ([\w:]+) \{", line):
            spaces.append(match[1])
        elif re.match(r"\}  // namespace", line):
            spaces.pop()
        elif spaces == ["carom"] and not line.startswith(" "):
            match = (re.match(r"(?:struct|class|enum class|enum) (\w+)(?: final)?(?: :[^:].*)? \{", line)
                     or re.match(r"using (\w+) = ", line)
                     or re.match(r"inline constexpr .*?(\w+)(?: =|\{)", line)
                     or re.match(r"(?:\[\[\w+\]\] |inline )*[A-Za-z][\w:<>, ]*[&*]? [&*]?(\w+)\(", line))
            if match:
                names.append(match[1])
    return names


def members_of(path, name):
    text = (ROOT / path).read_text()
    body = re.search(rf"^(?:struct|class) {name}(?: final)?(?: : [^{{]*)? \{{\n(.*?)^\}};", text, re.DOTALL | re.MULTILINE)[1]
    body = body.split("\n private:")[0]
    members = []
    for line in body.splitlines():
        if not re.match(r"  \w", line) or re.match(r"  (struct|enum|friend|template|using|explicit|static)", line):
            continue
        match = (re.match(rf"  [\w:<>,&* ]+?[ &*](?!{name}\b)(\w+)\(", line)
                 or re.match(r"  [\w:<>,&*() ]+[ &*](\w+)(?: =.*|\{.*)?;", line))
        if match and match[1] not in ("operator", "noexcept", name):
            members.append(match[1])
    return members


def found(path):
    """The object that a dotted name of Python stands for; None if there is none."""
    value = carom
    for part in path.split("."):
        value = getattr(value, part, None)
    return value


def test_every_public_name():
    wrong, seen = [], set()
    for path in public_headers():
        for name in names_of(path.read_text()):
            seen.add(name)
            if name.endswith("Of") and name not in LEFT_OUT and name not in RENAMED:
                continue  # a template: its instance for doubles has a name of its own
            if re.match(r"k[A-Z]", name):
                continue  # a constant
            there = found(RENAMED.get(name, name if name[0].isupper() else snake(name)))
            if there is None and name not in LEFT_OUT:
                wrong.append(f"{name} of {path.relative_to(ROOT)} is neither in Python nor left out with a reason")
            if there is not None and name in LEFT_OUT:
                wrong.append(f"{name} is in Python, and left out: {LEFT_OUT[name]}")
    wrong += [f"{name} is left out, and no public name" for name in LEFT_OUT if name not in seen]
    wrong += [f"{name} is renamed, and no public name" for name in RENAMED if name not in seen]
    assert not wrong, "\n".join(wrong)
    assert len(seen) > 150


@pytest.mark.parametrize("name", CLASSES)
def test_every_member(name):
    path, python, others = CLASSES[name]
    owner = found(python)
    members = members_of(path, name)
    assert len(members) >= 3
    if inspect.isclass(owner):
        there = set(dir(owner))
    else:
        there = set(re.findall(r"(\w+):", owner.__doc__.splitlines()[0]))
    missing = []
    for member in members:
        stands_for = others.get(member, snake(member))
        if stands_for in REASONS:
            assert snake(member) not in there, member
        elif stands_for not in there and stands_for + "_" not in there:
            missing.append(f"{name}::{member}")
    assert not missing
    assert [member for member in others if member not in members] == []


def test_names_are_documented():
    for name in carom.__all__:
        value = getattr(carom, name)
        if name == "__version__":
            continue
        assert value.__doc__, name
        if inspect.isclass(value) and not issubclass(value, Exception):
            for member in vars(value):
                if not member.startswith("_"):
                    assert getattr(value, member).__doc__, f"{name}.{member}"
                    assert member == snake(member), f"{name}.{member}"
    assert sorted(set(carom.__all__)) == sorted(carom.__all__)
