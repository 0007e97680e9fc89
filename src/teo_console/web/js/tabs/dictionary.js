// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Dictionary: every sign of the table, what it is founded on, and how it looks; what of a text has signs.

import { field, h } from "../dom.js";
import { figure, has } from "../i18n.js";
import { JobProgress } from "../parts/jobs.js";
import { signWriting } from "../parts/sign_writing.js";
import { pictureControls } from "../watch/picture_controls.js";

const MOST_SHOWN = 120; // more names than that nobody reads: the search is for them
const MOST_WANTED = 20; // an afternoon before the camera

export async function mount(element, context) {
  const { api, t, attempt } = context;
  element.append(h("h1", {}, t("tab.dictionary")));
  const loading = h("p", { role: "status" }, t("dictionary.loading"));
  element.append(loading);
  const signs = (await attempt(() => api.get("/api/signs"))) ?? [];
  loading.remove();
  const chosen = card(context);
  const found = search(context, signs, chosen.show);
  element.append(
    h("div", { class: "two dictionary" }, found.element, chosen.element, coverage(context)),
  );
  return () => {
    chosen.close();
    found.close();
  };
}

function search(context, signs, show) {
  const { t } = context;
  const { compare } = new Intl.Collator(document.documentElement.lang, { numeric: true }); // 2 before 10, É as E
  signs.sort((a, b) => compare(a.gloss, b.gloss));
  const word = h("input", { type: "text", id: "search-word", autocomplete: "off", spellcheck: "false" });
  const hand = select("search-hand", [["", t("dictionary.any")], ...[...new Set(signs.flatMap(({ handshapes }) => handshapes))].sort().map((name) => [name, name])]);
  const standing = select("search-standing", [["", t("dictionary.any")], ...["reviewed", "recorded", "measured", "described", "sketched"].map((name) => [name, t(`evidence.${name}`)])]);
  const topics = [...new Set(signs.flatMap((sign) => sign.topics))].filter((name) => has(`topic.${name}`)).map((name) => [name, t(`topic.${name}`)]);
  const topic = select("search-topic", [["", t("dictionary.any")], ...topics.sort(([, a], [, b]) => compare(a, b))]);
  const shape = handshape(context, signs);
  const kind = select("search-kind", [["", t("dictionary.any")], ...["lexical", "letter", "number"].map((name) => [name, t(`kind.${name}`)])]);
  // A language without sentences says nothing of how often its signs are made.
  const orders = signs.some(({ uses }) => uses > 0) ? ["alphabet", "use"] : ["alphabet"];
  const order = select("search-order", orders.map((name) => [name, t(`dictionary.order.${name}`)]));
  const count = h("p", { role: "status", class: "faint" });
  const list = h("ul", { class: "words", "aria-label": t("dictionary.results") });
  function find() {
    const wanted = plain(word.value);
    const found = signs.filter((sign) => plain(sign.gloss).includes(wanted) && (!hand.value || sign.handshapes.includes(hand.value)) && (!topic.value || sign.topics.includes(topic.value)) && (!standing.value || sign.standing === standing.value) && (!kind.value || sign.kind === kind.value));
    if (order.value === "use") found.sort((a, b) => b.uses - a.uses);
    found.sort((a, b) => plain(b.gloss).startsWith(wanted) - plain(a.gloss).startsWith(wanted));
    const shown = found.slice(0, MOST_SHOWN);
    const more = found.length - shown.length;
    count.textContent = t("dictionary.found", { count: found.length }) + (more > 0 ? ` ${t("dictionary.more", { more })}` : "");
    list.replaceChildren(...shown.map((sign) => h("li", {}, h("button", { type: "button", dataset: { gloss: sign.gloss }, on: { click: () => show(sign) } }, sign.gloss.replaceAll("_", " ")))));
  }
  for (const each of [word, topic, hand, standing, kind, order]) each.addEventListener("input", find);
  hand.addEventListener("input", () => shape.show(hand.value));
  find();
  const element = h(
    "section", { class: "card stack", "aria-labelledby": "search-title" },
    h("h2", { id: "search-title" }, t("dictionary.search")),
    h("div", { class: "fields" }, field(t("dictionary.word"), word), field(t("dictionary.topic"), topic), field(t("dictionary.handshape"), hand), field(t("dictionary.standing"), standing), field(t("dictionary.kind"), kind), field(t("dictionary.order"), order)),
    shape.element, count, list,
  );
  return { element, close: shape.close };
}

/** What a handshape is: the robot's hand in the letter that it is called after. */
function handshape({ socket, t, attempt, robotView }, signs) {
  const stage = h("div", { class: "hand-stage" });
  const words = h("p", {});
  const element = h("div", { class: "handshape", hidden: true }, stage, words);
  let view = null;
  async function show(letter) {
    element.hidden = !signs.some(({ gloss }) => gloss === letter);
    if (element.hidden) return;
    words.textContent = t("dictionary.handshape.means", { letter });
    view ??= robotView(stage);
    const answer = await attempt(() => socket.ask("get_sign", { gloss: letter }));
    if (!answer) return;
    (await view).play(answer.sign.motion);
    (await view).camera("hand");
  }
  return { element, show, close: async () => (await view)?.remove() };
}

function card(context) {
  const { socket, api, t, attempt, robotView } = context;
  const element = h("section", { class: "card stack", "aria-label": t("dictionary.sign") }, h("p", { class: "faint" }, t("dictionary.choose")));
  const progress = new JobProgress(api);
  let view = null;
  async function show(sign) {
    view?.remove();
    const stage = h("div", { class: "small-stage" });
    const film = h("div", {});
    const written = await signWriting(sign.gloss, sign.source);
    const name = sign.gloss.replaceAll("_", " ");
    const facts = [
      ["dictionary.standing", t(`evidence.${sign.standing}`)], ["dictionary.source", sign.source], ["dictionary.licence", sign.licence],
      ["dictionary.hands", t(`hands.${sign.handedness}`)], ["dictionary.handshapes", sign.handshapes.join(", ") || "–"],
      ["dictionary.duration", t("dictionary.seconds", { seconds: figure(sign.duration) })],
    ];
    const makeFilm = () => attempt(async () => {
      const made = await api.post("/api/films", { gloss: sign.gloss });
      if (made.job) await progress.finish(made.job);
      film.replaceChildren(h("video", { src: made.film, controls: true, loop: true, muted: true, autoplay: true, playsInline: true, class: "film", "aria-label": t("dictionary.film_of", { name }) }));
    });
    element.replaceChildren(...[
      h("h2", { tabindex: "-1" }, name),
      stage,
      h("div", { class: "row" },
        h("button", { type: "button", class: "primary", on: { click: () => attempt(() => socket.ask("sign_glosses", { glosses: [sign.gloss] })) } }, t("dictionary.robot")),
        h("button", { type: "button", on: { click: makeFilm } }, t("dictionary.film")),
        h("a", { class: "button", href: `#practise/${encodeURIComponent(sign.gloss)}` }, t("dictionary.practise"))),
      progress.element, film, written,
      h("dl", {}, ...facts.flatMap(([key, value]) => [h("dt", {}, t(key)), h("dd", {}, value)])),
      h("p", { class: "faint" }, t(`evidence.${sign.standing}.means`)),
    ].filter(Boolean));
    element.querySelector("h2").focus();
    view = await robotView(stage);
    stage.after(pictureControls(context, view));
    const answer = await attempt(() => socket.ask("get_sign", { gloss: sign.gloss }));
    if (answer) view.play(answer.sign.motion);
  }
  return { element, show, close: () => view?.remove() };
}

function coverage({ api, t, attempt }) {
  const text = h("textarea", { id: "coverage-text", rows: "4", maxlength: "5000" });
  const progress = new JobProgress(api);
  const result = h("div", { "aria-live": "polite" });
  async function look(event) {
    event.preventDefault();
    await attempt(async () => {
      const told = await progress.finish(await api.post("/api/coverage", { text: text.value }));
      const words = Object.entries(told.showings).filter(([, count]) => count > 0).map(([how, count]) => h("li", {}, `${has(`coverage.${how}`) ? t(`coverage.${how}`) : how}: ${count}`));
      const missing = Object.entries(told.missing).sort(([, a], [, b]) => b - a).slice(0, MOST_WANTED);
      const wanted = missing.map(([gloss, count]) => h("li", {}, h("a", { href: `#teach/${encodeURIComponent(gloss)}` }, gloss), ` · ${count}`));
      result.replaceChildren(
        h("h3", {}, t("coverage.words")), h("ul", { class: "plain" }, ...words),
        h("h3", {}, t("coverage.next")), wanted.length ? h("ol", { class: "plain" }, ...wanted) : h("p", {}, t("coverage.nothing")),
      );
    });
  }
  return h(
    "form", { class: "card stack", "aria-labelledby": "coverage-title", on: { submit: look } },
    h("h2", { id: "coverage-title" }, t("coverage.title")),
    field(t("coverage.text"), text),
    h("div", { class: "row" }, h("button", { type: "submit" }, t("coverage.look"))),
    progress.element, result,
  );
}

function select(id, options) {
  return h("select", { id }, ...options.map(([value, words]) => h("option", { value }, words)));
}

/** As words are compared: "Qué" is "que". */
function plain(text) {
  return text.normalize("NFD").replaceAll(/\p{Mn}/gu, "").toLowerCase().replaceAll("_", " ").trim();
}
