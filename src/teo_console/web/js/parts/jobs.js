// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Commands that the console runs: followed to their end, with a bar, words and a way to stop.

import { Refused } from "../api.js";
import { h } from "../dom.js";
import { has, t } from "../i18n.js";

const LOOK = 400; // [ms] between two looks at a job

const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));

/** Shows how far jobs are. `element` is to be placed; it is empty while nothing runs. */
export class JobProgress {
  element = h("div", { class: "job", hidden: true });
  #bar = h("progress", { "aria-label": t("job.progress") });
  #words = h("p", { role: "status", class: "faint" });
  #stop = h("button", { type: "button" }, t("job.cancel"));
  #api;

  constructor(api) {
    this.#api = api;
    this.element.append(this.#words, this.#bar, this.#stop);
  }

  /**
   * Follows a job to its end.
   * @param {Object} job As a request answered it.
   * @returns {Promise<*>} Its result; why it failed or was cancelled is thrown.
   */
  async finish(job) {
    this.#stop.hidden = false;
    this.#stop.onclick = () => this.#api.delete(`/api/jobs/${job.id}`);
    this.element.hidden = false;
    try {
      for (;;) {
        this.#show(job);
        if (job.state === "done") return job.result;
        if (job.state === "failed" || job.state === "cancelled") throw new Refused(job.code, job.message);
        await pause(LOOK);
        job = await this.#api.get(`/api/jobs/${job.id}`);
      }
    } finally {
      this.element.hidden = true;
    }
  }

  /**
   * Follows a series that is being prepared.
   * @param {string} name Of the preparation.
   * @returns {Promise<string>} The series' name.
   */
  async prepared(name) {
    this.#stop.hidden = true;
    this.element.hidden = false;
    try {
      for (;;) {
        const { done, total, result, code, message } = await this.#api.get(`/api/preparations/${name}`);
        this.#show({ name: "prepare", state: "running", progress: { done, total, what: "" } });
        if (result) return result;
        if (code) throw new Refused(code, message);
        await pause(LOOK);
      }
    } finally {
      this.element.hidden = true;
    }
  }

  /** Says that something goes on whose end is not known. */
  begin(name) {
    this.#stop.hidden = true;
    this.element.hidden = false;
    this.#show({ name, state: "running", progress: { done: 0, total: 0, what: "" } });
  }

  end() {
    this.element.hidden = true;
  }

  #show({ name, state, ahead, progress: { what, done, total } }) {
    const key = what ? `job.what.${what.split(" ")[0]}` : `job.${name}`;
    const words = state === "waiting" ? t(ahead > 0 ? "job.waiting" : "job.next", { ahead }) : has(key) ? t(key) : what || t("job.running");
    if (this.#words.textContent !== words) this.#words.textContent = words; // else it would be read aloud again
    if (total > 0 && state === "running") {
      this.#bar.max = total;
      this.#bar.value = done;
    } else this.#bar.removeAttribute("value");
  }
}
