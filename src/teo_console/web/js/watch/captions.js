// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The sentence's signs as captions: the one that is signed is lit and fills up; what is not a word's own sign is marked.

import { h } from "../dom.js";
import { mark } from "./marks.js";

const SIZES = [80, 100, 125, 150, 200]; // [%] of the page's type
// The driver's word may set the time of a sentence back by up to this [s]: a sign that was lit stays so meanwhile.
const SET_BACK = 1;

export class Captions {
  #context;
  #explain;
  #shown = null;
  #items = [];
  #lit = -1;

  constructor(context, explain) {
    const { settings, t } = context;
    this.#context = context;
    this.#explain = explain;
    this.text = h("p", { class: "sentence-text" }, t("captions.none"));
    this.form = h("p", { class: "sentence-form" });
    this.list = h("ol", { class: "captions", "aria-label": t("captions.label") });
    this.dropped = h("p", { class: "faint dropped" });
    const size = h("select", { id: "caption-size" });
    for (const percent of SIZES) size.append(h("option", { value: String(percent) }, `${percent} %`));
    size.value = String(settings.get("captionSize"));
    const resize = () => {
      settings.set("captionSize", Number(size.value));
      this.list.style.setProperty("--caption-size", String(Number(size.value) / 100));
    };
    size.addEventListener("change", resize);
    resize();
    this.element = h(
      "div", { class: "caption-box card" },
      h("div", { class: "row caption-head" },
        this.text,
        h("label", { class: "row small", for: "caption-size" }, t("captions.size"), size)),
      this.form,
      this.list,
      this.dropped,
    );
  }

  /** Shows a sentence and how far it is: `{sentence, elapsed}`, or null between sentences. */
  show(now) {
    if (!now) {
      if (this.#lit >= 0) this.#light(-1);
      return;
    }
    const { sentence, elapsed } = now;
    if (sentence !== this.#shown && signature(sentence) !== signature(this.#shown)) this.#build(sentence);
    this.#shown = sentence;
    let at = sentence.captions.findLastIndex(({ start }) => start !== null && start <= elapsed);
    if (at < this.#lit && sentence.captions[this.#lit].start - elapsed < SET_BACK) at = this.#lit;
    if (at !== this.#lit) this.#light(at);
    if (at >= 0) {
      const { start, duration } = sentence.captions[at];
      const share = duration > 0 ? Math.min(Math.max(elapsed - start, 0) / duration, 1) : 1;
      this.#items[at].bar.style.width = `${Math.round(share * 100)}%`;
      this.#items[at].item.classList.toggle("over", share >= 1);
    }
  }

  #build(sentence) {
    const { t } = this.#context;
    this.text.textContent = sentence.text || t("untitled");
    const said = [];
    if (sentence.form !== "statement") said.push(t(`form.${sentence.form}`));
    if (sentence.negated) said.push(t("form.negated"));
    if (sentence.uncertain) said.push(t("form.uncertain"));
    this.form.replaceChildren(...said.map((each) => h("span", { class: "pill" }, each)));
    this.form.hidden = !said.length;
    this.dropped.textContent = sentence.dropped.length ? t("captions.dropped", { words: sentence.dropped.join(", ") }) : "";
    this.#items = sentence.captions.map((caption, i) => this.#item(caption, sentence, followsOn(sentence.captions[i - 1], caption)));
    this.list.replaceChildren(...this.#items.map(({ item }) => item));
    this.#lit = -1;
    this.#explain(null);
  }

  #item(caption, sentence, follows) {
    const { t } = this.#context;
    const bar = h("span", { class: "bar" });
    const { symbol, name } = mark(caption);
    const gloss = caption.kind === "pause" ? t("captions.pause") : caption.gloss.replaceAll("_", " ");
    const button = h(
      "button", { type: "button", class: "caption", on: { click: () => this.#explain(caption, sentence) } },
      h("span", { class: "gloss" }, gloss),
      name && !follows ? h("span", { class: "mark" }, `${symbol} ${t(`mark.${name}`)}`) : null,
      bar,
    );
    const item = h("li", { class: `token ${caption.kind} ${follows ? "follows" : ""}`, dataset: { gloss: caption.gloss, origin: caption.origin } }, button);
    return { item, bar };
  }

  #light(at) {
    this.#items.forEach(({ item, bar }, i) => {
      item.classList.toggle("lit", i === at);
      item.classList.toggle("done", i < at);
      if (i === at) item.setAttribute("aria-current", "step");
      else item.removeAttribute("aria-current");
      if (i !== at) bar.style.width = i < at ? "100%" : "0";
    });
    this.#lit = at;
    if (at < 0) return;
    const { item } = this.#items[at];
    const { left, right } = item.getBoundingClientRect();
    const box = this.list.getBoundingClientRect();
    if (left < box.left || right > box.right) this.list.scrollLeft += left - box.left - box.width / 3;
  }
}

/** Whether a letter goes on with the word of the one before, whose mark stands for both. */
function followsOn(before, caption) {
  return caption.kind === "letter" && before?.kind === "letter" && before.word_index === caption.word_index;
}

function signature(sentence) {
  return sentence && `${sentence.utterance} ${sentence.index} ${sentence.captions.map(({ gloss }) => gloss).join(" ")}`;
}
