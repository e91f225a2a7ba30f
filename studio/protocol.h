// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "adjoint/base/errors.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/session_journal.h"

/// Messages of a page, version 1 (protocol.schema.json). Controls and constraints are read with the scene that they
/// belong to, so until then they are kept as JSON texts.
namespace carom::studio {

inline constexpr int kProtocol = 1;

/// The first message of a socket.
struct Hello {
  int protocol = 0;   ///< of the page
  std::string token;  ///< of the address that was printed
  std::string tab;    ///< the page's name for itself, kept when it is loaded again
};
/// Asks the server to show that it knows the token, before hello.
struct Prove {
  std::string nonce;
};
/// Grabs a body.
struct Grab {
  std::int64_t gesture = 0;  ///< the page's number for it
  std::string body;          ///< its name
  When at = 0.0;             ///< when, of the motion
  Grip grip;                 ///< how
  std::string also_vary;     ///< controls, a JSON array; empty: none
  bool free = false;         ///< if no control moves it, its throw varies from here on
};
/// Grabs the target of a nail.
struct GrabNail {
  std::int64_t gesture = 0;
  int nail = 0;
};
/// The current target of a drag.
struct Drag {
  std::int64_t gesture = 0, seq = 0;
  Vec3 place = Vec3::Zero();        ///< m
  std::optional<Quat> orientation;  ///< shape to world
  std::vector<std::string> components = {};  ///< of a contact that slides: those held from here on
};
/// Lets go.
struct Release {
  std::int64_t gesture = 0, seq = 0;
  std::optional<Vec3> place;        ///< m, where the hand was last
  std::optional<Quat> orientation;  ///< shape to world
  bool nail = false;                ///< where it got to
  std::vector<std::string> components = {};  ///< as of a drag
};
/// Lets go, and back to what was before.
struct Cancel {
  std::int64_t gesture = 0;
};
struct Undo {};
struct Redo {};
/// Ends what is under way.
struct Stop {};
struct MeetNails {};
/// A new nail: a constraint, or a body as it is at a moment.
struct MakeNail {
  std::string constraint;  ///< JSON; empty: the body as it is
  std::string body;
  When at = 0.0;
};
struct SetNail {
  int nail = 0;
  std::string constraint;  ///< JSON
};
struct NailOn {
  int nail = 0;
  bool on = true;
};
/// Whether no gesture changes the impact sequence from here on.
struct KeepSequence {
  bool on = false;
};
struct Unnail {
  int nail = 0;
  std::string sketch;  ///< notes of the nails of a sketch, which go together; empty: one nail
};
/// All controls, from now on.
struct SetControls {
  std::int64_t rev = 0;  ///< of the session that the page knew
  std::string controls;  ///< JSON array
};
/// Numbers typed into the document.
struct SetNumbers {
  std::int64_t rev = 0;
  std::vector<std::pair<std::string, std::string>> edits;  ///< pointer into the document, value as JSON
};
/// The same numbers, to be shown and not kept.
struct Try {
  std::int64_t gesture = 0, seq = 0;
  SetNumbers set;
};
/// A place on a surface.
struct OnSurface {
  Vec3 point = Vec3::Zero();   ///< m
  Vec3 normal = Vec3::Zero();  ///< out of what is below it
};
/// Another body.
struct AddBody {
  std::int64_t rev = 0;
  std::string body;             ///< JSON, as in documents; where its name is taken it gets another
  std::optional<OnSurface> on;  ///< where it touches; none: where it says
};
struct RemoveBody {
  std::int64_t rev = 0;
  std::string body;  ///< its name
};
/// The same body again, beside it.
struct CopyBody {
  std::int64_t rev = 0;
  std::string body;
};
struct RenameBody {
  std::int64_t rev = 0;
  std::string body, name;  ///< now, and from here on
};
/// A scene with a floor and nothing else.
struct NewScene {
  bool replace = false;  ///< even where what is there has not been saved
};
struct Open {
  std::string path;      ///< relative to the folder, or to that of the gallery
  bool gallery = false;  ///< one of its scenes
  bool replace = false;  ///< even where what is there has not been saved
};
struct Save {
  std::optional<std::string> path;  ///< relative; none: where it was opened
  bool replace = false;             ///< even where another wrote there
};
/// The motion as a file, for the page to keep.
struct Export {
  std::string format;   ///< "glb", "py", "csv", "svg" or "html"
  bool before = false;  ///< beside the motion as it was opened, where the format has that
  bool cubic = false;   ///< glb: a key per impact (GltfKeys::cubic)
};
/// What would help where a gesture did not reach its target.
struct Why {
  std::int64_t rev = 0;
};
/// Other motions that meet the same.
struct Alternatives {
  std::int64_t rev = 0;
  int count = 6;  ///< at most
};
/// Takes one of the remedies that were found.
struct TakeRemedy {
  std::int64_t rev = 0;
  std::string name;  ///< of the remedy
};
/// Takes one of the other motions that were found.
struct Adopt {
  std::int64_t rev = 0;
  int index = 0;  ///< of the motion
};
/// Looks for a throw with which a body comes to rest with a face up, and takes it.
struct FaceUp {
  std::int64_t rev = 0;
  std::string body;             ///< its name
  Vec3 up = Vec3::Zero();       ///< normal of the face, in the axes of the shape
  std::optional<Vec2> place = {};  ///< m, where its centre of mass is then; none: anywhere
  bool nail = false;            ///< that is held from here on
};
/// Fits the path of a body to a drawn curve.
struct Sketch {
  std::int64_t rev = 0;
  std::string body;          ///< its name
  double from = 0;           ///< s, when the curve begins
  std::vector<Vec3> places;  ///< m, along the curve
};
/// A part of a file that the page has, for Import.
struct Upload {
  std::string name;    ///< of the file, without folders
  std::size_t at = 0;  ///< bytes of it that came before; 0: a new file
  std::string bytes;
};
/// A glTF file becomes a scene, which is opened; an OBJ file is looked at, and put into the folder where it was uploaded.
struct Import {
  std::string path;      ///< relative to the folder; empty: the file that was uploaded
  std::string as;        ///< of glTF without physics: "hull", "mesh", "box" or "sphere"; empty: its physics
  bool replace = false;  ///< even where what is open has not been saved
};
struct List {
  std::string path;     ///< a folder
  bool meshes = false;  ///< mesh files in place of scenes
};
struct Gallery {};
/// A socket went away; never read from a message.
struct Gone {};
struct Findings;
/// Something was found in the background; never read from a message.
struct Found {
  std::shared_ptr<const Findings> what;
};

/// A command with the number that its answers carry.
struct Command {
  std::int64_t id = 0;  ///< 0: nobody waits for an answer
  std::variant<Hello, Prove, Grab, GrabNail, Drag, Release, Cancel, Undo, Redo, Stop, MeetNails, MakeNail, SetNail, NailOn,
               Unnail, KeepSequence, SetControls, SetNumbers, Try, AddBody, RemoveBody, CopyBody, RenameBody, NewScene, Open, Save, Export,
               Why, Alternatives, TakeRemedy, Adopt, FaceUp, Sketch, Upload, Import, List, Gallery, Gone, Found>
      what;  ///< what it asks for
};

/// Stops a release, or nails that are being met.
bool interrupts(const Command& command);
/// Ends a gesture as if it had not been, or asks for less: what a drag under way comes to does not matter.
bool endsHold(const Command& command);
/// What a drag that waits would come to does not matter once this command of the same page comes: it says where the
/// hand is now, or puts everything back. A release without a target of its own needs the drag before it.
bool makesNeedless(const Command& later, const Drag& waiting);
/// Comes to the same before and after a drag that waits.
bool passesDrags(const Command& command);

/// What is wrong with a message; `re` is its number, where it could be read.
class MessageError : public InputError {
 public:
  MessageError(std::int64_t number, const InputError& error) : InputError(error), re(number) {}
  const std::int64_t re;  ///< 0: unknown
};
/// Reads a message. Throws MessageError, which names the place, what was found and what was expected.
Command readCommand(std::string_view text);

/// Controls of a message, in the words of scene documents. Errors begin at `where`. Throws InputError.
std::vector<Control> readControlsText(const std::string& json, const Scene& scene, const std::string& where);
/// A constraint of a message, likewise.
Constraint readConstraintText(const std::string& json, const Scene& scene, double duration, const std::string& where);

}  // namespace carom::studio
