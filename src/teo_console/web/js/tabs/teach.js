// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Teach: film a sign, look at what TEO makes of it, and keep it or try again.

import { field, h } from "../dom.js";
import { camera } from "../parts/camera.js";
import { JobProgress } from "../parts/jobs.js";
import { glossOf } from "../parts/word_field.js";
import { gateList, GATES } from "../teach/gates.js";
import { outcome } from "../teach/outcome.js";

export async function mount(element, context) {
  const { api, t, attempt, notify } = context;
  const gloss = h("input", { type: "text", id: "teach-gloss", maxlength: "60", autocomplete: "off", spellcheck: "false" });
  gloss.value = decodeURIComponent(location.hash.split("/")[1] ?? "").replaceAll("_", " ");
  const hands = h("select", { id: "teach-hands" }, ...["", "right", "left", "both"].map((name) => h("option", { value: name }, t(`teach.hands.${name || "seen"}`))));
  const progress = new JobProgress(api);
  const result = h("div", {}, explained(t));
  const filming = camera(context, { onFilm: (film) => attempt(() => look(film)), ready, bags: true });
  let recording = null;
  let shown = { close() {} };

  const name = () => glossOf(gloss.value);

  /** Whether the word is there, which the film is to show. */
  function ready() {
    if (name()) return true;
    gloss.focus();
    notify(t("teach.name_first"));
    return false;
  }

  /** Brings a film onto TEO and shows both; nothing is kept yet. */
  async function look(film) {
    if (!ready()) return;
    await discard();
    progress.begin("upload");
    try {
      ({ recording } = await api.post("/api/recordings", film));
    } finally {
      progress.end();
    }
    const wanted = { gloss: name(), hands: hands.value || null };
    const told = await progress.finish(await api.post(`/api/recordings/${recording}/try`, wanted));
    shown = await outcome(context, { told, wanted, film, recording, progress, again: discard, forget });
    result.replaceChildren(shown.element);
    shown.element.querySelector("h2").focus();
  }

  /** Deletes the film on this machine: what it showed is in the table. */
  async function forget() {
    await api.delete(`/api/recordings/${recording}`);
    recording = null;
  }

  /** Deletes the film, on this machine and then here: what a page shows no more is gone. */
  async function discard() {
    shown.close();
    shown = { close() {} };
    if (recording) await api.delete(`/api/recordings/${recording}`).catch(() => {}); // it may be gone already
    recording = null;
    result.replaceChildren(explained(t));
  }

  element.append(
    h("h1", {}, t("tab.teach")),
    h("div", { class: "two" },
      h("section", { class: "card stack", "aria-labelledby": "teach-title" },
        h("h2", { id: "teach-title" }, t("teach.show")),
        h("div", { class: "fields" }, field(t("teach.word"), gloss), field(t("teach.hands"), hands)),
        filming.element, progress.element),
      result),
  );
  return () => {
    filming.close();
    discard();
  };
}

/** What will be looked at, before there is anything to look at. */
function explained(t) {
  return h("section", { class: "card stack", "aria-labelledby": "explained-title" },
    h("h2", { id: "explained-title" }, t("teach.explained")),
    h("p", {}, t("teach.explained.why")),
    gateList(GATES.map((code) => ({ code, passed: null }))));
}
