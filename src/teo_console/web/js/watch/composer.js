// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The text box: type, Enter, watch. Where the browser recognises speech, a microphone fills it; nothing is signed
// before it is confirmed.

import { h } from "../dom.js";

const Recognition = window.SpeechRecognition ?? window.webkitSpeechRecognition;
const LONGEST = 2000; // characters, as the protocol takes them

export function composer({ socket, attempt, notify, t }) {
  const { names } = socket.welcome;
  const text = h("input", {
    type: "text", id: "text", autocomplete: "off", maxlength: String(LONGEST), spellcheck: true,
    lang: names?.spoken ?? "", placeholder: names?.example ?? "",
  });
  const form = h(
    "form", { class: "card composer", on: { submit } },
    h("label", { for: "text" }, t("compose.label")),
    h("div", { class: "row" }, text, h("button", { type: "submit", class: "primary" }, t("compose.sign"))),
  );
  if (Recognition) form.lastChild.append(microphone(text, notify, t));

  async function submit(event) {
    event.preventDefault();
    const typed = text.value.trim();
    if (!typed) return;
    if (await attempt(() => socket.ask("sign_text", { text: typed }))) text.value = "";
    text.focus();
  }
  return form;
}

/** A button that listens; what it hears goes into the text box, to be read and confirmed there. */
function microphone(text, notify, t) {
  const button = h("button", { type: "button", "aria-pressed": "false" }, t("speech.listen"));
  let listening = null;
  button.addEventListener("click", () => {
    if (listening) {
      listening.stop();
      return;
    }
    listening = new Recognition();
    listening.lang = text.lang;
    listening.addEventListener("result", ({ results }) => {
      text.value = results[0][0].transcript.slice(0, LONGEST);
      text.focus();
      notify(t("speech.check"));
    });
    listening.addEventListener("error", ({ error }) => notify(t("speech.failed", { error })));
    listening.addEventListener("end", () => {
      listening = null;
      button.setAttribute("aria-pressed", "false");
    });
    button.setAttribute("aria-pressed", "true");
    listening.start();
  });
  return button;
}
