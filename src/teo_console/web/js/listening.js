// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Listeners that go together: a tab that is left takes all of its own with it.

export class Listening {
  #controller = new AbortController();

  /** Calls the handler with the detail of each event of that name. */
  on(target, name, handler) {
    target.addEventListener(name, (event) => handler(event.detail ?? event), { signal: this.#controller.signal });
  }

  /** Calls a function every so many milliseconds. */
  every(period, action) {
    const timer = setInterval(action, period);
    this.#controller.signal.addEventListener("abort", () => clearInterval(timer));
  }

  end() {
    this.#controller.abort();
  }
}
