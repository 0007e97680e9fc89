// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Practise: choose a word, see TEO sign it, sign it to the camera, and read what differs.

import { filmOf, h } from "../dom.js";
import { figure } from "../i18n.js";
import { camera } from "../parts/camera.js";
import { JobProgress } from "../parts/jobs.js";
import { wordField } from "../parts/word_field.js";
import { refusalText } from "../status.js";
import { pictureControls } from "../watch/picture_controls.js";

// Differences by their size, in the unit of recognition: half of all people's right signs differ by less than one; from
// two on another handshape, place or movement is seen.
const SMALL = 1;
const LARGE = 2;
const MOST = 4; // the bar, which tells how alike they are, is empty

export async function mount(element, context) {
  const { api, socket, t, attempt, notify, robotView } = context;
  element.append(h("h1", {}, t("tab.practise")));
  const signs = attempt(() => api.get("/api/signs")).then((all) => all ?? []);
  let known = null;
  signs.then((all) => (known = new Set(all.map(({ gloss }) => gloss))));
  const word = wordField(t("practise.word"), signs);
  const given = decodeURIComponent(location.hash.split("/")[1] ?? "");
  const stage = h("div", { class: "small-stage" });
  const beside = h("div", {}, stage); // and the learner's film, once there is one
  const progress = new JobProgress(api);
  const result = h("div", {});
  const filming = camera(context, { onFilm: (film) => attempt(() => look(film)), ready });
  const see = h("button", { type: "submit", class: "primary" }, t("practise.see"));
  let view = null;

  async function show(event) {
    event?.preventDefault();
    const answer = await attempt(() => socket.ask("get_sign", { gloss: word.value() || "?" }));
    result.replaceChildren();
    forget();
    if (answer) view.play(answer.sign.motion);
  }

  /** Whether the word is one of the table, as far as that has been read: a browser gives no film long after a click. */
  function ready() {
    const gloss = word.value();
    if (gloss && (!known || known.has(gloss))) return true;
    word.input.focus();
    notify(t("practise.word_first"));
    return false;
  }

  /** The film that is seen beside the robot, which stays in this browser. */
  function forget() {
    const shown = beside.querySelector("video");
    if (shown) URL.revokeObjectURL(shown.src);
    beside.className = "";
    beside.replaceChildren(stage);
  }

  function showBeside(film) {
    beside.className = "side-by-side";
    beside.prepend(filmOf(film, t("practise.film")));
  }

  async function look(film) {
    await signs;
    if (!ready()) return;
    const gloss = word.value();
    await show(); // to be compared with what is meant, whatever was seen last
    showBeside(film);
    progress.begin("upload");
    const { recording } = await api.post("/api/recordings", film).finally(() => progress.end());
    try {
      const told = await progress.finish(await api.post(`/api/recordings/${recording}/recognise`, { gloss }));
      result.replaceChildren(told.code === "recognised" ? verdict(t, gloss, told) : refused(t, told));
      result.querySelector("h2").focus();
    } finally {
      await api.delete(`/api/recordings/${recording}`); // a learner's film is never kept
    }
  }

  element.append(
    h("div", { class: "two" },
      h("div", { class: "stack" },
        h("form", { class: "card stack", on: { submit: show } }, word.element, h("div", { class: "row" }, see), beside),
        result),
      h("section", { class: "card stack", "aria-labelledby": "practise-title" }, h("h2", { id: "practise-title" }, t("practise.you")), filming.element, progress.element)),
  );
  view = await robotView(stage);
  beside.after(pictureControls(context, view));
  if (given) {
    word.input.value = given.replaceAll("_", " ");
    await show();
  }
  return () => {
    filming.close();
    forget();
    view.remove();
  };
}

function refused(t, told) {
  return h("section", { class: "card stack" }, h("h2", { tabindex: "-1" }, t("practise.not_seen")), h("p", {}, refusalText(told.code)));
}

/** What it looked like, and which part of the sign differs. */
function verdict(t, gloss, { matches, compared }) {
  const name = (each) => each.replaceAll("_", " ");
  const place = matches.findIndex((match) => match.gloss === gloss);
  const key = place === 0 ? "practise.right" : place > 0 ? "practise.near" : "practise.other";
  const parts = ["handshape", "orientation", "place", "movement"].map((part) => {
    const size = compared[part];
    const word = size < SMALL ? "small" : size < LARGE ? "middle" : "large";
    return h("li", { class: `difference ${word}`, dataset: { part, size: word } },
      h("span", { id: `part-${part}` }, t(`part.${part}`)),
      h("meter", { min: 0, max: MOST, low: MOST - LARGE, high: MOST - SMALL, optimum: MOST, value: Math.max(MOST - size, 0), "aria-labelledby": `part-${part}` }),
      h("span", {}, `${t(`practise.${word}`)} · ${figure(size)}×`));
  });
  return h(
    "section", { class: "card stack", "aria-live": "polite" },
    h("h2", { tabindex: "-1", dataset: { verdict: key } }, t(key, { name: name(gloss), other: name(matches[0].gloss) })),
    compared.hands ? null : h("p", {}, t("practise.hands")),
    h("h3", {}, t("practise.differs", { name: name(gloss) })),
    h("ul", { class: "plain" }, ...parts),
    h("p", { class: "faint" }, t("practise.unit")),
    h("h3", {}, t("practise.looks_like")),
    h("ol", { class: "plain" }, ...matches.map((match) => h("li", {}, `${name(match.gloss)} · ${figure(match.distance)}`))),
    h("p", { class: "faint" }, t("practise.how_sure")),
  );
}
