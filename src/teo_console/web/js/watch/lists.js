// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What waits, what was, and what is reported.

import { h } from "../dom.js";
import { refusalText } from "../status.js";

/** Sentences that wait, and a button that forgets them. */
export function queue({ socket, attempt, t }, listening) {
  const list = h("ol", { class: "plain" });
  const clear = h("button", { type: "button", id: "clear", on: { click: empty } }, t("queue.clear"));
  function empty() {
    return attempt(() => socket.ask("command", { order: "clear_queue" }));
  }
  const nothing = h("p", { class: "faint" }, t("queue.none"));
  function show(situation) {
    const waiting = situation.queue.filter(({ current }) => !current);
    list.replaceChildren(...waiting.map(({ text }) => h("li", {}, text || t("untitled"))));
    nothing.hidden = waiting.length > 0;
    clear.hidden = !waiting.length;
  }
  listening.on(socket, "situation", show);
  if (socket.situation) show(socket.situation);
  return h("section", { class: "card", "aria-labelledby": "queue-title" }, h("h2", { id: "queue-title" }, t("queue.title")), nothing, list, clear);
}

/** What nodes report of themselves, in their own words: for whoever runs them. */
export function reports({ socket, t }, listening) {
  const element = h("div", {});
  let shown = "";
  function show({ nodes }) {
    const unwell = nodes.filter(({ state }) => state === "unwell");
    const now = JSON.stringify(unwell);
    if (now === shown) return;
    shown = now;
    element.replaceChildren(...unwell.map(({ role, message }) => h("p", { class: "faint small" }, t("robot.reports", { node: t(`node.${role}`) }), " ", h("q", { lang: "en" }, message))));
  }
  listening.on(socket, "situation", show);
  return element;
}

/** Sentences that were signed or refused, each to be signed again, and the last text that was not translated. */
export function history({ socket, attempt, t }, listening) {
  const list = h("ol", { class: "plain history" });
  const nothing = h("p", { class: "faint" }, t("history.none"));
  let shown = "";

  function item(sentence) {
    const text = sentence.text || sentence.captions.map(({ gloss }) => gloss).join(" ");
    const again = () => attempt(() => socket.ask("sign_text", { text }));
    const signed = sentence.state === "signed";
    const glosses = sentence.captions.map(({ gloss, kind }) => (kind === "pause" ? "·" : gloss)).join(" ");
    return h(
      "li", {},
      h("div", {},
        h("span", {}, text),
        h("span", { class: "faint small" }, signed ? glosses : t("history.refused", { why: refusalText(sentence.code) }))),
      sentence.text ? h("button", { type: "button", "aria-label": t("history.again_label", { text }), on: { click: again } }, t("history.again")) : null,
    );
  }
  function refusalItem({ text, code }) {
    return h("li", {}, h("div", {}, h("span", {}, text), h("span", { class: "faint small" }, t("history.refused", { why: refusalText(code) }))));
  }
  function show(situation) {
    const items = [...situation.history];
    const now = JSON.stringify([situation.refusal, items.map(({ utterance, index, state }) => [utterance, index, state])]);
    if (now === shown) return; // or a button would lose the focus
    shown = now;
    list.replaceChildren(...(situation.refusal ? [refusalItem(situation.refusal)] : []), ...items.map(item));
    nothing.hidden = list.children.length > 0;
  }
  listening.on(socket, "situation", show);
  if (socket.situation) show(socket.situation);
  return h("section", { class: "card", "aria-labelledby": "history-title" }, h("h2", { id: "history-title" }, t("history.title")), nothing, list);
}
