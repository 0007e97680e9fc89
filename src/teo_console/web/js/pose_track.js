// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Poses by time, and the moment that is drawn: now, or later and slower.

// Ten minutes at 30 Hz: a long text at half speed.
const MOST_POSES = 18000;
// Frames come every 33 ms: drawn this much later there is one on either side [s].
const BUFFER = 0.08;
// A jump of the node's clock, or of this computer's after sleep [s].
const CLOCK_JUMP = 1.0;
// Joints that moved less than this between two poses stand still [rad].
const STILL = 1e-4;

export class PoseTrack {
  joints = [];
  #poses = [];
  #offset = null; // node's clock less this page's [s]

  /** Begins anew with other joints. */
  reset(joints) {
    this.joints = joints;
    this.#poses = [];
  }

  push({ stamp, positions }) {
    const newest = this.#poses.at(-1);
    if (newest && (stamp < newest.stamp || positions.length !== newest.positions.length)) this.#poses = [];
    this.#poses.push({ stamp, positions });
    if (this.#poses.length > MOST_POSES) this.#poses.splice(0, MOST_POSES / 10);
    this.hear(stamp);
  }

  /** Takes the node's time from a message: the one that was least late tells best. */
  hear(stamp) {
    const offset = stamp - performance.now() / 1000;
    if (this.#offset === null || offset > this.#offset || this.#offset - offset > CLOCK_JUMP) this.#offset = offset;
  }

  /** The node's time of what is drawn without delay [s]. */
  live() {
    return this.#offset === null ? 0 : performance.now() / 1000 + this.#offset - BUFFER;
  }

  /** Positions at a time, between the two poses around it; null without a pose. */
  at(time) {
    const poses = this.#poses;
    if (!poses.length) return null;
    const after = this.#after(time);
    if (after === 0) return poses[0].positions;
    if (after === poses.length) return poses.at(-1).positions;
    const [a, b] = [poses[after - 1], poses[after]];
    const share = (time - a.stamp) / (b.stamp - a.stamp || 1);
    return a.positions.map((value, joint) => value + share * (b.positions[joint] - value));
  }

  /** The time from which on something moves, at or after a time; null if nothing does. */
  nextMovement(time) {
    for (let i = Math.max(this.#after(time), 1); i < this.#poses.length; i++) {
      const [a, b] = [this.#poses[i - 1], this.#poses[i]];
      if (a.positions.some((value, joint) => Math.abs(value - b.positions[joint]) > STILL)) return a.stamp;
    }
    return null;
  }

  #after(time) {
    let low = 0;
    let high = this.#poses.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.#poses[middle].stamp <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

// Rest that is passed over when the picture lags [s].
const REST = 0.5;

/** The moment that is drawn. At rate 1 it is the live one; slower, it falls behind and catches up while TEO rests. */
export class ViewClock {
  rate = 1;
  #track;
  #time = null;
  #drawn = 0;

  constructor(track) {
    this.#track = track;
  }

  /** The node's time that is to be drawn now [s]. */
  now() {
    const drawn = performance.now() / 1000;
    const passed = Math.min(drawn - this.#drawn, 0.25); // a page in the background draws nothing
    this.#drawn = drawn;
    const live = this.#track.live();
    if (this.rate === 1 || this.#time === null || this.#time > live) this.#time = live;
    else this.#time = Math.min(this.#time + passed * this.rate, live);
    if (this.rate !== 1) {
      const movement = this.#track.nextMovement(this.#time);
      if (movement === null) this.#time = live;
      else if (movement - this.#time > REST) this.#time = Math.min(movement - REST, live);
    }
    return this.#time;
  }

  /** How far the picture is behind [s]. */
  get lag() {
    return this.#time === null ? 0 : Math.max(this.#track.live() - this.#time, 0);
  }

  toLive() {
    this.#time = null;
  }
}
