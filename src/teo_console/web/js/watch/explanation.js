// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// A caption in words: what it stands for, how it came about, and how well founded its sign is.

import { h } from "../dom.js";
import { has } from "../i18n.js";
import { signWriting } from "../parts/sign_writing.js";
import { mark } from "./marks.js";

/** Makes the box; `show(caption, sentence)` fills it, `show(null)` empties it. */
export function explanation({ socket, t }) {
  const title = h("h2", {}, t("explain.title"));
  const body = h("div", {}, h("p", { class: "faint" }, t("explain.none")));
  let turn = 0;

  async function show(caption, sentence) {
    const mine = ++turn;
    if (!caption) {
      title.textContent = t("explain.title");
      body.replaceChildren(h("p", { class: "faint" }, t("explain.none")));
      return;
    }
    title.textContent = caption.kind === "pause" ? t("captions.pause") : caption.gloss.replaceAll("_", " ");
    const { name } = mark(caption);
    const words = caption.words.length ? caption.words.map((word) => `«${word}»`).join(" ") : t("explain.no_words");
    const lines = [t(`explain.${name || caption.kind}`, { words, gloss: caption.gloss })];
    if (caption.inflection) lines.push(t("explain.inflection", { form: inflectionOf(caption.inflection, t) }));
    if (sentence.form !== "statement") lines.push(t(`explain.${sentence.form}`));
    if (sentence.negated) lines.push(t("explain.negated"));
    body.replaceChildren(...lines.map((line) => h("p", {}, line)));
    if (caption.kind === "pause") return;
    let provenance;
    try {
      const { sign } = await socket.ask("get_sign", { gloss: caption.gloss });
      ({ provenance } = JSON.parse(sign.entry));
    } catch {
      return; // no executor, or no entry of that name: the words above stand without it
    }
    const { standing, source } = provenance;
    const written = await signWriting(caption.gloss, source);
    if (mine !== turn) return;
    body.append(...(written ? [written] : []), h("p", { class: "faint" }, t(`standing.${standing}`, { source })));
  }

  return { element: h("section", { class: "card explanation", "aria-live": "polite" }, title, body), show };
}

function inflectionOf(form, t) {
  const [from, to] = form.split(">");
  if (to) return t("inflection.between", { from: t(`person.${from}`), to: t(`person.${to}`) });
  return has(`inflection.${form}`) ? t(`inflection.${form}`) : form;
}
