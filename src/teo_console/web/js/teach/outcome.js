// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What became of a film: demonstration and robot side by side, gates, signs that look like it, and what to do with it.

import { filmOf, h } from "../dom.js";
import { figure } from "../i18n.js";
import { refusalText } from "../status.js";
import { pictureControls } from "../watch/picture_controls.js";
import { acceptForm } from "./accept_form.js";
import { gateList } from "./gates.js";

/**
 * Shows a trial.
 * @param {Object} context The tab's.
 * @param {Object} trial `told` by the capture, what was `wanted`, the `film`, the `recording` on this machine, the
 *   `progress` of jobs, and `again()`, which discards it.
 * @returns {Promise<{element: HTMLElement, close: Function}>}
 */
export async function outcome(context, { told, wanted, film, recording, progress, again, forget }) {
  const { api, socket, t, robotView } = context;
  const video = filmOf(film, t("teach.demonstration"));
  const isFilm = !film.name?.endsWith(".mcap");
  const redo = h("button", { type: "button", on: { click: again } }, t("teach.again"));
  const close = () => URL.revokeObjectURL(video.src);
  if (told.code !== "captured") {
    const element = h(
      "section", { class: "card stack", "aria-labelledby": "outcome-title" },
      h("h2", { id: "outcome-title", tabindex: "-1" }, t("teach.refused")),
      h("p", {}, told.gates.length ? t("teach.beyond") : refusalText(told.code)),
      isFilm ? video : null,
      told.gates.length ? gateList(told.gates) : null,
      h("div", { class: "row" }, redo),
    );
    return { element, close };
  }
  const { motion } = await api.get(`/api/recordings/${recording}/trial`);
  const exists = await socket.ask("get_sign", { gloss: told.gloss }).then(() => true, () => false);
  const stage = h("div", { class: "small-stage" });
  const failed = told.gates.filter(({ passed }) => !passed);
  let view = null;
  /** Shows a second of the recording in the film, and what TEO does then. */
  const look = (at) => {
    video.pause();
    video.currentTime = at;
    const [begin, end] = told.stroke;
    view.hold(Math.min(Math.max((at - begin) / (end - begin), 0), 1));
    stage.scrollIntoView({ block: "nearest" });
  };
  video.addEventListener("play", () => view?.play(motion));
  const element = h(
    "section", { class: "card stack", "aria-labelledby": "outcome-title" },
    h("h2", { id: "outcome-title", tabindex: "-1" }, t(failed.length ? "teach.doubtful" : "teach.good", { name: told.gloss.replaceAll("_", " ") })),
    h("div", { class: "side-by-side" }, isFilm ? video : h("p", { class: "faint" }, t("teach.a_bag")), stage),
    h("p", {}, t("teach.compare")),
    h("h3", {}, t("teach.gates")), gateList(told.gates, isFilm ? look : null),
    h("h3", {}, t("teach.similar")), similar(t, told.similar),
    acceptForm(context, { gloss: told.gloss, hands: wanted.hands, exists, failed, recording, progress, redo, forget }),
  );
  view = await robotView(stage);
  view.play(motion);
  stage.parentElement.after(pictureControls(context, view));
  return {
    element,
    close() {
      close();
      view.remove();
    },
  };
}

// Differences that are just seen: below two, both are taken for each other.
const ALIKE = 2;

function similar(t, signs) {
  if (!signs.length) return h("p", {}, t("teach.similar.none"));
  return h("ul", { class: "plain similar" }, ...signs.map(({ gloss, seen }) => h("li", {}, h("strong", {}, gloss.replaceAll("_", " ")), ` · ${t(seen < ALIKE ? "teach.similar.alike" : "teach.similar.apart", { seen: figure(seen) })}`)));
}
