// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The connection to the node: the shared situation, poses, and requests with their answers.

import { Refused } from "./api.js";

// The node repeats the situation every second: three of them missed, and it is gone [ms].
const SILENCE = 3500;
/** What the node did not give is asked for again after so long [ms]. */
export const RECONNECT = 1000;

/** Events: "situation", "welcome", "pose" (detail: what came), "connection" (detail: whether it stands). */
export class Socket extends EventTarget {
  situation = null;
  welcome = { names: null, joints: [], robot: false };
  connected = false;
  #socket = null;
  #waiting = new Map();
  #next = 1;
  #watchdog = 0;

  connect() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.#socket = new WebSocket(`${scheme}://${location.host}/ws`);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.addEventListener("message", (event) => this.#receive(event.data));
    this.#socket.addEventListener("close", () => {
      this.#lost();
      setTimeout(() => this.connect(), RECONNECT);
    });
  }

  /**
   * Asks the node for something.
   * @param {string} type Of protocol.schema.json, as "sign_text".
   * @param {Object} fields The rest of the message.
   * @returns {Promise<Object>} Its answer; refused ones are thrown.
   */
  ask(type, fields = {}) {
    if (!this.connected) return Promise.reject(new Refused("no_console", "the console does not answer"));
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#socket.send(JSON.stringify({ type, id, ...fields }));
    });
  }

  #receive(data) {
    this.#alive();
    if (data instanceof ArrayBuffer) {
      const pose = { stamp: new DataView(data).getFloat64(0, true), positions: new Float32Array(data, 8) };
      this.#tell("pose", pose);
      return;
    }
    const message = JSON.parse(data);
    if (message.type === "answer") this.#answer(message);
    else {
      this[message.type] = message;
      this.#tell(message.type, message);
    }
  }

  #answer(message) {
    const asked = this.#waiting.get(message.id);
    this.#waiting.delete(message.id);
    const refused = message.success ? null : new Refused(message.code, message.message);
    if (asked) refused ? asked.reject(refused) : asked.resolve(message);
    else if (refused) this.#tell("refused", refused);
  }

  #alive() {
    clearTimeout(this.#watchdog);
    this.#watchdog = setTimeout(() => this.#socket.close(), SILENCE);
    if (!this.connected) {
      this.connected = true;
      this.#tell("connection", true);
    }
  }

  #lost() {
    clearTimeout(this.#watchdog);
    for (const { reject } of this.#waiting.values()) reject(new Refused("no_console", "the connection was lost"));
    this.#waiting.clear();
    if (this.connected) {
      this.connected = false;
      this.#tell("connection", false);
    }
  }

  #tell(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}
