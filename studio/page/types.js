// SPDX-License-Identifier: MIT
// The words of the protocol and of the page's own state, for the type checker. SI units, z up, quaternions [w, x, y, z].

/** @typedef {[number, number, number]} Vec3 */
/** @typedef {[number, number, number, number]} Quat */
/** @typedef {number | {impact: number, with?: string} | {between: [number, number]} | {rest: true}} When  as in scene documents */
/** @typedef {{vary: string, body?: string, material?: string, impact?: number, components?: string[],
 *    min?: number | number[], max?: number | number[], weight?: number, notes?: string}} Control */
/** @typedef {null | number | {min?: number, max?: number}} Target */
/** @typedef {{body: string, at?: When, position?: Target[], contact?: Target[], orientation?: Quat, velocity?: Target[],
 *    angular_velocity?: Target[], speed?: Target, kinetic_energy?: Target, impulse?: Target, height?: Target,
 *    time?: Target, point?: {body_point: Vec3, world: Target[]}, relative_to?: string,
 *    avoid?: unknown, inside?: unknown, notes?: string, soft?: number}} Constraint */

/** @typedef {{control: number, name: string, component: string, opened: number, now: number, min: number | null,
 *    max: number | null, scale: number, at_bound: 'min' | 'max' | null, pointer: string | null}} NumberState */
/** @typedef {{id: number, constraint: Constraint, on: boolean, available: boolean, met: boolean, time: number | null,
 *    error: number, message: string}} NailState */
/** Members after material: as the document has them, of bodies whose numbers can be typed; shape: of simple ones.
 * @typedef {{name: string, fixed: boolean, kinematic?: boolean, mass: number | null, material?: string, position?: Vec3,
 *    orientation?: Quat, velocity?: Vec3, angular_velocity?: Vec3, density?: number, written_mass?: number,
 *    shape?: Record<string, Record<string, number | number[]>>}} BodyState */
/** @typedef {{type: 'state', re?: number, rev: number, open: boolean, path: string | null, name?: string,
 *    suggested?: string, saved: boolean, recovered?: number, repairs?: string[], duration: number, controls: Control[], numbers: NumberState[], nails: NailState[],
 *    keep_sequence?: boolean, undo: string | null, redo: string | null, held_by: string | null, bodies: BodyState[],
 *    materials?: {name: string, elasticity: number, friction: number}[]}} DocumentState */

/** `nth`: of each body as which of its impacts it counts, 0 where it has none; `pairs`: who meets whom.
 * @typedef {{t: number, point: Vec3, bodies: number[], nth: number[], pairs: [number, number][], mode: string}} Impact */
/** @typedef {{kind: string, numbers?: string[], sentence: string}} Obstacle */
/** @typedef {{t: number, bodies: number[], mode?: string, point?: Vec3}} ChangeEvent */
/** @typedef {{kind: string, before: ChangeEvent | null, after: ChangeEvent | null, sentence: string}} SequenceChange */
/** A track: see motion.js.
 * @typedef {{body: number, arcs: Float64Array, stride?: number, turns: Float32Array,
 *    center: Vec3}} Track  stride: numbers a row of arcs, 10 unless it says so */
/** A stretch in which a body rests, slides, rolls, pivots or rides on others.
 * @typedef {{body: number, on: number[], kind: string, from: number, to: number}} ContactStretch */
/** @typedef {{rev: number, stage: string, reached: boolean, distance: number, turn: number, nailError: number,
 *    stopped: boolean, more: boolean, obstacle: Obstacle | null, changes: SequenceChange[], end: number,
 *    status: string, message: string, gravity: Vec3, impacts: Impact[], contacts: ContactStretch[], tracks: Track[], gesture?: number, seq?: number,
 *    re?: number}} Motion  everything that the page knows about one motion; tracks in the order of bodies */
/** @typedef {{body: number, name: string, fixed: boolean, plane: {normal: Vec3, offset: number} | null,
 *    colour: string, vertices: Float32Array, normals: Float32Array | null, triangles: Uint32Array | null,
 *    accent: Uint32Array | null, center: Vec3, radius: number}} Shape  accent: triangles of a lighter shade */
/** @typedef {{shapes: Shape[], min: Vec3, max: Vec3}} SceneShapes */

/** What lies under the pointer, or is held.
 * @typedef {{kind: 'path' | 'body' | 'impact' | 'rest' | 'nail' | 'handle', body: number, time: number, at: When, place: Vec3,
 *    nail?: number, impact?: Impact, handle?: string}} Hit */
/** What would help; solves: null until it was tried.
 * @typedef {{name: string, kind: string, removes: number, solves: boolean | null}} Remedy */
/** searching: for remedies.
 * @typedef {{message: string, kind?: 'plain' | 'amber' | 'red', actions?: {name: string, act: () => void}[],
 *    key?: string, remedies?: Remedy[], searching?: boolean}} Notice */
/** Another motion that meets the same. size: of its change, the smallest that was found 1.
 * @typedef {{index: number, motion: Motion, size: number | null, impacts: string[]}} Other */
/** @typedef {{rev: number, list: Other[], searching: boolean, message: string, taken: number, taking: boolean}} Others */
/** A body that is to come to rest with a face up. name: of the face; up: its normal, in the axes of the shape; place: on the surface where
 * it is to lie; searching: for a throw; tried: so many.
 * @typedef {{body: number, name: string, up: Vec3, place: Vec3 | null, searching: boolean, tried: number}} FacingState */
/** A curve that the pen draws. from: s, when it begins; places: along it; searching: for a path.
 * @typedef {{body: number, from: number, places: Vec3[], searching: boolean}} SketchState */
/** The gesture under way, as the drawing parts see it.
 * @typedef {{state: 'idle' | 'pressed' | 'dragging' | 'typing' | 'settling', number: number, hit: Hit | null,
 *    target: Vec3 | null, turn: Quat | null, axis: string, seq: number, answered: number, settlingShown: boolean,
 *    nailing: boolean, snap: number, snapOn: string}} GestureState  snap: steps of the target, m or rad; 0: none; snapOn: the mark or surface that it went to */

/** @typedef {'connecting' | 'loading' | 'open' | 'lost' | 'ended'} Connected */
/** @typedef {{connected: Connected, progress: string, folder: string, document: DocumentState | null,
 *    scene: SceneShapes | null, motion: Motion | null, opened: Motion | null, savedMotion: Motion | null,
 *    before: Motion | null, showBefore: 'none' | 'opened' | 'saved' | 'changes', changesShown: boolean,
 *    time: number, playing: boolean,
 *    speed: number, loop: boolean, loopRange: [number, number] | null, dots: number, selected: number, hover: Hit | null, tool: 'move' | 'turn' | 'throw' | 'face' | 'pen', adding: number, mesh: string,
 *    gesture: GestureState, nailOnRelease: boolean, leaveRestFree: boolean, turnLeavesPlace: boolean, keymap: 'blender' | 'maya',
 *    locked: ReadonlySet<string>, panel: boolean, quality: 'low' | 'high', notice: Notice | null, card: Notice | null,
 *    bodiesAsOpened: boolean, facing: FacingState | null, sketch: SketchState | null, others: Others | null, preview: Motion | null, noticesStay: boolean, selectedNail: number, tab: string, looking: boolean}} State  bodiesAsOpened: none came, went or has another name since;
 *    noticesStay: for tests, which take their time;
 *    looking: nothing can be changed; preview: of the others, the one that is pointed at; adding: which of `additions` the next press puts down, the one behind them: the file `mesh`; -1: none */

export {};
