// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Watch: type, and see TEO sign it.

import { h } from "../dom.js";
import { Listening } from "../listening.js";
import { Captions } from "../watch/captions.js";
import { composer } from "../watch/composer.js";
import { explanation } from "../watch/explanation.js";
import { history, queue, reports } from "../watch/lists.js";
import { pictureControls } from "../watch/picture_controls.js";
import { robotControls } from "../watch/robot_controls.js";
import { spokenTexts } from "../watch/spoken_texts.js";

// Time between two looks at what is signed [ms]: a sixth of a letter's.
const CAPTION_PERIOD = 50;

export async function mount(element, context) {
  const { live, t } = context;
  const listening = new Listening();
  const explained = explanation(context);
  const captions = new Captions(context, explained.show);
  const stage = h("div", { class: "picture" });
  const main = h(
    "section", { class: "watching", "aria-label": t("watch.robot") },
    spokenTexts(context, listening),
    composer(context),
    stage,
    captions.element,
  );
  const aside = h(
    "div", { class: "beside" },
    explained.element,
    robotControls(context, listening),
    queue(context, listening),
    history(context, listening),
    reports(context, listening),
  );
  element.append(
    h("h1", { class: "visually-hidden" }, t("tab.watch")),
    h("div", { class: "watch" }, main, aside),
  );
  const view = await context.robotView(stage);
  captions.element.after(pictureControls(context, view));
  // By the clock, not with each picture: where drawing is slow, a letter would be passed over.
  listening.every(CAPTION_PERIOD, () => captions.show(live.sentenceAt(live.clock.now())));
  return () => {
    listening.end();
    view.remove();
  };
}
