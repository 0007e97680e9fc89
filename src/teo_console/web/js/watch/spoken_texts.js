// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What a recogniser in the graph has heard (topic `speech`): shown, mended where it is wrong, and confirmed or discarded.

import { h } from "../dom.js";

export function spokenTexts({ socket, attempt, t }, listening) {
  const list = h("ul", { class: "spoken", "aria-live": "polite", "aria-label": t("speech.heard") });
  let shown = "";

  function item({ id, text }) {
    const field = h("input", { type: "text", value: text, id: `spoken-${id}`, lang: socket.welcome.names?.spoken ?? "" });
    field.value = text;
    const sign = () => attempt(() => socket.ask("confirm_spoken", { spoken: id, text: field.value.trim() || text }));
    const discard = () => attempt(() => socket.ask("discard_spoken", { spoken: id }));
    return h(
      "li", { class: "card" },
      h("label", { for: `spoken-${id}` }, t("speech.is_this_right")),
      h("div", { class: "row" },
        field,
        h("button", { type: "button", class: "primary", on: { click: sign } }, t("compose.sign")),
        h("button", { type: "button", on: { click: discard } }, t("speech.discard"))),
    );
  }

  function show({ spoken }) {
    const now = spoken.map(({ id }) => id).join();
    list.hidden = !spoken.length;
    if (now === shown) return; // or what is being mended would be lost
    shown = now;
    list.replaceChildren(...spoken.map(item));
  }
  listening.on(socket, "situation", show);
  show(socket.situation ?? { spoken: [] });
  return list;
}
