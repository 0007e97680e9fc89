// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Commands that the console runs: followed to their end, with a bar, words and a way to stop.

import { Refused } from "../api.js";
import { h } from "../dom.js";
import { has, t } from "../i18n.js";
import { refusalText } from "../status.js";

const LOOK = 400; // [ms] between two looks at a job

const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));

/** Shows how far jobs are, and why the last one failed. `element` is to be placed. */
export class JobProgress {
  element = h("div", { class: "job", hidden: true });
  #bar = h("progress", { "aria-label": t("job.progress") });
  #words = h("p", { role: "status", class: "faint" });
  #stop = h("button", { type: "button" }, t("job.cancel"));
  #api;
  #failed = "";

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
    try {
      for (;;) {
        this.#show(job);
        if (job.state === "done") return job.result;
        if (job.state === "failed" || job.state === "cancelled") throw new Refused(job.code, job.message);
        await pause(LOOK);
        job = await this.#api.get(`/api/jobs/${job.id}`);
      }
    } catch (error) {
      this.#failed = refusalText(error.code);
      throw error;
    } finally {
      this.end();
    }
  }

  /**
   * Follows a series that is being prepared.
   * @param {string} name Of the preparation.
   * @returns {Promise<string>} The series' name.
   */
  async prepared(name) {
    this.#stop.hidden = true;
    try {
      for (;;) {
        const { done, total, result, code, message } = await this.#api.get(`/api/preparations/${name}`);
        this.#show({ name: "prepare", state: "running", progress: { done, total, what: "" } });
        if (result) return result;
        if (code) throw new Refused(code, message);
        await pause(LOOK);
      }
    } catch (error) {
      this.#failed = refusalText(error.code);
      throw error;
    } finally {
      this.end();
    }
  }

  /** Says that something goes on whose end is not known. */
  begin(name) {
    this.#stop.hidden = true;
    this.#show({ name, state: "running", progress: { done: 0, total: 0, what: "" } });
  }

  /** Nothing goes on any more; why it failed stays to be read. */
  end() {
    this.#bar.hidden = this.#stop.hidden = true;
    this.#words.textContent = this.#failed;
    this.element.hidden = !this.#failed;
    this.#failed = "";
  }

  #show({ name, state, ahead, progress: { what, done, total } }) {
    const key = what ? `job.what.${what.split(" ")[0]}` : `job.${name}`;
    const words = state === "waiting" ? t(ahead > 0 ? "job.waiting" : "job.next", { ahead }) : t(has(key) ? key : "job.running");
    this.element.hidden = this.#bar.hidden = false;
    if (this.#words.textContent !== words) this.#words.textContent = words; // else it would be read aloud again
    if (total > 0 && state === "running") {
      this.#bar.max = total;
      this.#bar.value = done;
    } else this.#bar.removeAttribute("value");
  }
}
