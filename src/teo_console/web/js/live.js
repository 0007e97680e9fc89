// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What happens now, kept so that it can be shown later and slower: poses, and how far which sentence was.

import { PoseTrack, ViewClock } from "./pose_track.js";

// As many as poses are kept for: ten minutes of a situation ten times a second.
const MOST_MOMENTS = 6000;

export class Live {
  track = new PoseTrack();
  clock = new ViewClock(this.track);
  #moments = [];

  constructor(socket) {
    socket.addEventListener("welcome", ({ detail }) => {
      if (detail.joints.join() !== this.track.joints.join()) this.track.reset(detail.joints);
    });
    socket.addEventListener("pose", ({ detail }) => this.track.push(detail));
    socket.addEventListener("situation", ({ detail }) => this.#remember(detail));
  }

  #remember({ stamp, current, progress }) {
    this.track.hear(stamp);
    const last = this.#moments.at(-1);
    if (last && stamp < last.stamp) this.#moments = []; // the node's clock was set
    this.#moments.push({ stamp, current, progress });
    if (this.#moments.length > MOST_MOMENTS) this.#moments.splice(0, MOST_MOMENTS / 10);
  }

  /** The sentence at a time of the node's, and how far its motion was [s]; null between sentences. */
  sentenceAt(time) {
    let moment = null;
    for (let i = this.#moments.length - 1; i >= 0 && !moment; i--) {
      if (this.#moments[i].stamp <= time) moment = this.#moments[i];
    }
    moment ??= this.#moments[0] ?? null;
    if (!moment?.current || !moment.progress) return null;
    const { elapsed, speed, stamp } = moment.progress;
    const passed = elapsed + speed * Math.max(time - stamp, 0);
    return { sentence: moment.current, elapsed: Math.min(passed, moment.current.duration) };
  }
}
