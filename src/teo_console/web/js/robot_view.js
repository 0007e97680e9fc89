// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The robot in 3D, placed in any element: it follows the live poses, or plays a motion of its own.

import {
  DirectionalLight, HemisphereLight, OrbitControls, PerspectiveCamera, Scene, SphereGeometry, URDFLoader, Vector3, WebGLRenderer,
} from "../vendor/robot_drawing.js";
import { h } from "./dom.js";

// Presets in the robot's axes [m]: x forward, y to its left, z up, from the base; `view` is the vertical opening [deg],
// `across` the least horizontal one where that is another: what arms span.
// Heights are those of a robot whose head ends at `TOP`; others have theirs in proportion. `hand` is relative to the
// hand that moves. The signer's view is from the eyes.
const CAMERAS = {
  // Eyes as high as the robot's, so that a hand held before the chin is seen there; from the hips to a raised letter.
  front: { from: [1.85, 0.0, 0.72], at: [0.0, 0.0, 0.51], view: 32, across: 36 },
  hand: { from: [0.46, -0.08, 0.04], at: [0, 0, 0], view: 36 },
  signer: { from: [0.1, 0.0, 0.76], at: [0.5, 0.0, 0.64], view: 85 },
};
const TOP = 0.8087; // TEO
const DARKER = 0.45; // the light of what is no hand: hands are to stand out from the trunk
const FINGERS = 3; // links on which so many chains of joints hang, and none with as many, are hands
const WIDEST_VIEW = 90; // [deg], to which a narrow picture may open
// The hand that signs, in a corner of the picture: this part of its shorter side, on a ground that sets it apart.
const INSET = 0.36;
const INSET_VIEW = 28; // [deg]
const INSET_GROUND = 0x3b5063;
// Where the picture is turned by an arrow key, so far [rad], and no nearer to straight above or below.
const TURN = Math.PI / 18;
const STEEPEST = 0.2;
// A hand that moved this much more than the other is the one that signs [m], within about a second of frames.
const HAND_LEAD = 0.02;
const FORGET = 0.97;
// Time in which the camera goes two thirds of the way after the hand [s].
const CHASE = 0.3;
const PIXEL_RATIO = 2; // finer than that nobody sees, and a telephone would draw nine times the pixels
// A picture that takes longer than this, so many times in a row, is drawn with fewer pixels from then on: a computer
// without a graphics card draws with its processor.
const SLOW = 60; // [ms]
const SLOW_FRAMES = 5;
const COARSER = 0.7; // times the pixels of a row
const COARSEST = 0.35; // of the page's
// Pictures that a processor draws come this far apart at least [ms]: fifteen a second show a movement, and what is left
// of it receives poses and looks at films.
const PROCESSOR_PERIOD = 1000 / 15;

let description = null; // one download for all views

/**
 * Places the robot.
 * @param {HTMLElement} place Gets the picture as its child; its size is the picture's.
 * @param {Object} options `socket`, `live`, `t`.
 * @returns {Promise<Object>} `camera(name)`, `mirrored(on)`, `play(motion)`, `hold(share)`, `follow()`, `remove()`,
 *   and `rate`, the seconds of a played motion a second.
 */
export async function robotView(place, { socket, live, t }) {
  const view = new RobotView(place, live, t);
  view.begin(socket);
  return view;
}

class RobotView {
  rate = 1;
  #robot = null;
  #motion = null;
  #hand = new HandThatSigns({});
  #height = 1; // of the robot's head over TOP
  #preset = "front";
  #shown = null;
  #dirty = true;
  #ratio = Math.min(devicePixelRatio, PIXEL_RATIO);
  #drawnAt = null; // when the picture before was drawn [ms]; null after a rest
  #slow = 0;
  #removed = new AbortController();

  constructor(place, live, t) {
    this.live = live;
    this.place = place;
    place.classList.add("stage");
    this.empty = h("p", { class: "empty" }, t("view.waiting"));
    place.append(this.empty);
    // On a graphics card, with smooth edges; by the processor where there is none.
    this.renderer = rendererWith({ antialias: true, failIfMajorPerformanceCaveat: true });
    this.period = this.renderer ? 0 : PROCESSOR_PERIOD;
    this.renderer ??= rendererWith({});
    if (!this.renderer) {
      this.empty.textContent = t("view.no_webgl");
      return;
    }
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", t("view.label"));
    this.canvas.tabIndex = 0;
    this.canvas.addEventListener("keydown", (event) => this.#turn(event));
    this.inset = h("div", { class: "inset", hidden: true });
    place.prepend(this.canvas, this.inset);
    this.scene = new Scene();
    this.scene.add(new HemisphereLight(0xffffff, 0x8a96a3, 2.2));
    const sun = new DirectionalLight(0xffffff, 1.8);
    sun.position.set(2, 1.2, 3);
    this.scene.add(sun);
    this.eye = new PerspectiveCamera(CAMERAS.front.view, 1, 0.02, 20);
    this.eye.up.set(0, 0, 1);
    this.handEye = new PerspectiveCamera(INSET_VIEW, 1, 0.02, 20);
    this.handEye.up.set(0, 0, 1);
    this.handAt = new Vector3();
    this.controls = new OrbitControls(this.eye, this.canvas);
    this.controls.addEventListener("change", () => (this.#dirty = true));
    this.camera("front");
    this.resizing = new ResizeObserver(() => this.#resize());
    this.resizing.observe(place);
  }

  /** Loads the robot as soon as the node knows it, and draws. */
  begin(socket) {
    if (!this.renderer) return;
    const load = async () => {
      if (this.#robot || !socket.welcome.robot) return;
      description ??= fetch("/api/robot.urdf").then((response) => (response.ok ? response.text() : Promise.reject(response)));
      try {
        this.#robot ??= new URDFLoader().parse(await description);
      } catch {
        description = null; // it was not there yet: the next welcome tells
        return;
      }
      lighten(this.#robot);
      this.scene.add(this.#robot);
      this.#robot.updateMatrixWorld(true);
      this.#height = topOf(this.#robot) / TOP;
      const hands = handsOf(this.#robot);
      darken(this.#robot, Object.values(hands).map((link) => link.parent.parent));
      this.#hand = new HandThatSigns(hands);
      this.camera(this.#preset);
      this.empty.hidden = true;
      this.#dirty = true;
    };
    socket.addEventListener("welcome", load, { signal: this.#removed.signal });
    load();
    this.#draw();
  }

  /** Looks from a preset: "front", "hand" or "signer". */
  camera(name) {
    this.#preset = name;
    if (!this.eye) return;
    const { from, at } = CAMERAS[name];
    this.#chase(1);
    if (name === "hand") {
      this.#lookAtHand();
    } else {
      this.eye.position.set(from[0], from[1], from[2] * this.#height);
      this.controls.target.set(at[0], at[1], at[2] * this.#height);
    }
    this.controls.update();
    this.#resize();
  }

  /** Shows the picture as in a mirror. */
  mirrored(on) {
    this.place.classList.toggle("mirrored", on);
  }

  /**
   * Plays a motion instead of following the robot, again and again.
   * @param {{joints: string[], times: number[], positions: number[][]}} motion Times from 0 [s], positions [rad].
   */
  play(motion) {
    this.#motion = { ...motion, time: 0, held: false };
  }

  /** Stands still at a moment of the motion that is played, 0 at its begin to 1 at its end. */
  hold(share) {
    this.#motion = { ...this.#motion, time: share * this.#motion.times.at(-1), held: true };
  }

  /** Whether it plays a motion of its own. */
  get plays() {
    return this.#motion !== null;
  }

  /** Follows the robot again. */
  follow() {
    this.#motion = null;
  }

  /** Lets go of everything. */
  remove() {
    this.#removed.abort();
    this.resizing?.disconnect();
    this.controls?.dispose();
    this.renderer?.dispose();
    this.place.replaceChildren();
  }

  #draw(before = performance.now()) {
    if (this.#removed.signal.aborted) return;
    const now = performance.now();
    if (now - before < this.period) {
      requestAnimationFrame(() => this.#draw(before));
      return;
    }
    const passed = (now - before) / 1000;
    requestAnimationFrame(() => this.#draw(now));
    const time = this.live.clock.now();
    const [joints, positions] = this.#motion ? this.#played(passed) : [this.live.track.joints, this.live.track.at(time)];
    if (this.#robot && positions && !same(positions, this.#shown)) {
      joints.forEach((name, i) => this.#robot.setJointValue(name, positions[i]));
      this.#shown = positions;
      this.#dirty = true;
      this.#hand.look();
    }
    this.#chase(1 - Math.exp(-passed / CHASE));
    if (!this.#dirty) {
      this.#drawnAt = null;
      return;
    }
    this.#render();
    this.#adapt(performance.now());
  }

  #render() {
    this.#dirty = false;
    this.renderer.render(this.scene, this.eye);
    if (!this.inset.hidden) this.#renderInset();
  }

  #adapt(now) {
    const took = this.#drawnAt === null ? 0 : now - this.#drawnAt;
    this.#drawnAt = now;
    this.#slow = took > SLOW ? this.#slow + 1 : 0;
    if (this.#slow < SLOW_FRAMES || this.#ratio <= COARSEST) return;
    this.#slow = 0;
    this.#ratio *= COARSER;
    this.#resize();
  }

  #renderInset() {
    const { offsetLeft, offsetTop, clientWidth: side } = this.inset;
    // In the picture's own axes, up from its lower edge; it is the canvas that is mirrored, not what is drawn.
    const left = this.place.classList.contains("mirrored") ? this.place.clientWidth - offsetLeft - side : offsetLeft;
    const box = [left, this.place.clientHeight - offsetTop - side, side, side];
    this.renderer.setScissorTest(true);
    this.renderer.setScissor(...box);
    this.renderer.setViewport(...box);
    this.renderer.setClearColor(INSET_GROUND, 1);
    this.renderer.render(this.scene, this.handEye);
    this.renderer.setClearColor(0, 0);
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, this.place.clientWidth, this.place.clientHeight);
  }

  #turn(event) {
    const keys = { ArrowLeft: [-TURN, 0], ArrowRight: [TURN, 0], ArrowUp: [0, -TURN], ArrowDown: [0, TURN] };
    if (!(event.key in keys)) return;
    event.preventDefault(); // the page stays where it is
    const [aside, down] = keys[event.key];
    const away = this.eye.position.clone().sub(this.controls.target).applyAxisAngle(this.eye.up, aside);
    const steep = Math.min(Math.max(away.angleTo(this.eye.up) + down, STEEPEST), Math.PI - STEEPEST) - away.angleTo(this.eye.up);
    away.applyAxisAngle(this.eye.up.clone().cross(away).normalize(), steep);
    this.eye.position.copy(this.controls.target).add(away);
    this.controls.update();
    this.#dirty = true;
  }

  #played(passed) {
    const { joints, times, positions, held } = this.#motion;
    const last = times.at(-1);
    const pause = 1; // [s] before it begins again
    if (!held) this.#motion.time = (this.#motion.time + passed * this.rate) % (last + pause);
    const time = Math.min(this.#motion.time, last);
    const after = Math.max(times.findIndex((each) => each >= time), 0);
    const before = Math.max(after - 1, 0);
    const share = after === before ? 0 : (time - times[before]) / (times[after] - times[before] || 1);
    return [joints, positions[before].map((value, i) => value + share * (positions[after][i] - value))];
  }

  #chase(share) {
    const link = this.#hand.link;
    if (!link) return;
    const { from } = CAMERAS.hand;
    const at = link.getWorldPosition(new Vector3());
    const side = this.#hand.side === "right" ? 1 : -1;
    const eye = at.clone().add(new Vector3(from[0], from[1] * side, from[2]));
    if (this.handAt.distanceTo(at) < 1e-3 && this.handEye.position.distanceTo(eye) < 1e-3) return;
    this.handAt.lerp(at, share);
    this.handEye.position.lerp(eye, share);
    this.handEye.lookAt(this.handAt);
    if (this.#preset === "hand") this.#lookAtHand();
    this.#dirty = true;
  }

  #lookAtHand() {
    this.eye.position.copy(this.handEye.position);
    this.controls.target.copy(this.handAt);
    this.controls.update();
  }

  #resize() {
    const { clientWidth, clientHeight } = this.place;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(this.#ratio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.eye.aspect = clientWidth / clientHeight;
    // A narrow picture shows as much of the arms' span as a wide one.
    const { view, across = view } = CAMERAS[this.#preset];
    this.eye.fov = Math.min(Math.max(view, across / this.eye.aspect), WIDEST_VIEW);
    this.eye.updateProjectionMatrix();
    this.inset.hidden = this.#preset === "hand" || !this.#hand.link;
    this.inset.style.width = this.inset.style.height = `${Math.round(INSET * Math.min(clientWidth, clientHeight))}px`;
    this.#render(); // at once: a canvas of another size is an empty one
  }
}

/** Rounds balls with fewer triangles: the loader's have 1,740 each, nine tenths of the whole robot's. */
function lighten(robot) {
  const ball = new SphereGeometry(1, 20, 14);
  robot.traverse((part) => {
    if (part.geometry?.type === "SphereGeometry") part.geometry = ball;
  });
}

/** Darkens all of a robot but its hands. */
function darken(robot, hands) {
  robot.traverse((part) => {
    if (!part.material || hands.some((hand) => within(part, hand))) return;
    part.material = part.material.clone(); // hands may share it
    part.material.color.multiplyScalar(DARKER);
  });
}

/** Height at which a robot ends [m]. */
function topOf(robot) {
  let top = 0;
  robot.traverse((part) => {
    if (!part.geometry) return;
    part.geometry.computeBoundingBox();
    top = Math.max(top, part.geometry.boundingBox.clone().applyMatrix4(part.matrixWorld).max.z);
  });
  return top;
}

/** Draws; null where there is no WebGL 2 with these options. */
function rendererWith(options) {
  try {
    return new WebGLRenderer({ alpha: true, powerPreference: "low-power", ...options });
  } catch {
    return null;
  }
}

/**
 * The hands of a robot, whatever its links are called: of each the knuckle in the middle.
 * @returns {{right?: Object, left?: Object}} Links.
 */
function handsOf(robot) {
  const chains = (link) => link.children.filter((joint) => joint.isURDFJoint && joint.jointType !== "fixed");
  const isHand = (link) => chains(link).length >= FINGERS;
  const links = Object.values(robot.links).filter(isHand);
  const hands = links.filter((link) => !links.some((other) => other !== link && within(other, link)));
  const found = {};
  for (const hand of hands) {
    const knuckles = chains(hand).map((joint) => joint.getWorldPosition(new Vector3()));
    const middle = knuckles.reduce((sum, at) => sum.add(at), new Vector3()).divideScalar(knuckles.length);
    const nearest = knuckles.map((at) => at.distanceTo(middle));
    const joint = chains(hand)[nearest.indexOf(Math.min(...nearest))];
    found[middle.y < 0 ? "right" : "left"] = joint.children.find((child) => child.isURDFLink);
  }
  return found;
}

function within(part, whole) {
  for (let above = part.parent; above; above = above.parent) if (above === whole) return true;
  return false;
}

/** Which hand signs: the one that has moved farther lately. */
class HandThatSigns {
  side = "right";
  #way = { right: 0, left: 0 };
  #last = {};

  constructor(hands) {
    this.hands = hands;
  }

  get link() {
    return this.hands[this.side];
  }

  look() {
    for (const [side, link] of Object.entries(this.hands)) {
      const at = link.getWorldPosition(new Vector3());
      this.#way[side] = this.#way[side] * FORGET + (this.#last[side]?.distanceTo(at) ?? 0);
      this.#last[side] = at;
    }
    const other = this.side === "right" ? "left" : "right";
    if (this.#way[other] > this.#way[this.side] + HAND_LEAD) this.side = other;
  }
}

function same(a, b) {
  return b !== null && a.length === b.length && a.every((value, i) => value === b[i]);
}
