// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// One item after the other: the robot moves, the reviewer says what it was, and only then reads it and judges.

import { field, h } from "../dom.js";
import { pictureControls } from "../watch/picture_controls.js";

const FLAGS = ["handshape", "place", "palm", "movement", "speed", "face"];
const RATINGS = ["right", "understandable", "wrong"];

export async function questions(element, context, series) {
  const { api, t, attempt, notify, settings, robotView } = context;
  const stage = h("div", { class: "picture" });
  const seen = h("div", { class: "stack" }, stage);
  const asked = h("section", { class: "card stack", "aria-live": "polite" });
  const name = h("input", { type: "text", id: "reviewer", maxlength: "60", autocomplete: "nickname", required: true });
  name.value = settings.get("reviewer") ?? "";
  let view = null;

  const reviewer = () => name.value.trim();
  const body = h("div", { class: "two", hidden: true }, seen, asked);
  const begin = h("form", { class: "card stack", on: { submit: start } },
    h("p", {}, t("review.welcome")), field(t("review.name"), name),
    h("div", { class: "row" }, h("button", { type: "submit", class: "primary" }, t("review.begin"))));
  element.append(begin, body);

  async function start(event) {
    event.preventDefault();
    settings.set("reviewer", reviewer());
    begin.remove();
    body.hidden = false;
    view ??= await robotView(stage);
    seen.append(pictureControls(context, view));
    await next();
  }

  function next() {
    return attempt(async () => {
      const { question } = await api.post(`/api/series/${series}/next`, { reviewer: reviewer() });
      if (!question) {
        view.follow();
        asked.replaceChildren(h("h2", { tabindex: "-1", id: "all-done" }, t("review.done")), h("p", {}, t("review.thanks")), h("a", { class: "button", href: "#review" }, t("review.back")));
      } else {
        view.play(question.motion);
        asked.replaceChildren(...(question.understood === null ? understanding(question) : judging(question)));
      }
      asked.querySelector("h2").focus();
    });
  }

  function heading(question) {
    return h("h2", { tabindex: "-1" }, t(question.kind === "sign" ? "review.sign" : "review.sentence", { place: question.place, items: question.items }));
  }

  function understanding(question) {
    const say = (understood) => attempt(async () => {
      const { meaning } = await api.post(`/api/items/${question.item}/answer`, { reviewer: reviewer(), understood });
      if (meaning === null) return next();
      asked.replaceChildren(...judging({ ...question, understood, meaning }));
      asked.querySelector("h2").focus();
      return null;
    });
    const nothing = h("button", { type: "button", on: { click: () => say("") } }, t("review.nothing"));
    if (question.choices.length) {
      const buttons = question.choices.map((choice) => h("li", {}, h("button", { type: "button", dataset: { choice }, on: { click: () => say(choice) } }, choice.replaceAll("_", " "))));
      return [heading(question), h("p", {}, t("review.which")), h("ul", { class: "choices" }, ...buttons), h("div", { class: "row" }, nothing)];
    }
    const words = h("input", { type: "text", id: "understood", maxlength: "200", autocomplete: "off" });
    const submit = (event) => {
      event.preventDefault();
      if (words.value.trim()) say(words.value.trim());
      else words.focus();
    };
    return [heading(question), h("form", { class: "stack", on: { submit } }, field(t("review.what"), words), h("div", { class: "row" }, h("button", { type: "submit", class: "primary" }, t("review.say")), nothing))];
  }

  function judging(question) {
    const rating = h("fieldset", { class: "options" }, h("legend", {}, t("review.rating")), ...RATINGS.map((value) => option("radio", "rating", value, t(`rating.${value}`))));
    const flags = h("fieldset", { class: "options" }, h("legend", {}, t("review.flags")), ...FLAGS.map((value) => option("checkbox", "flag", value, t(`flag.${value}`))));
    const comment = h("textarea", { id: "comment", rows: "2", maxlength: "2000" });
    const submit = (event) => {
      event.preventDefault();
      return attempt(async () => {
        const chosen = [...flags.querySelectorAll(":checked")].map((input) => input.value);
        const told = rating.querySelector(":checked");
        if (!told) {
          rating.querySelector("input").focus();
          notify(t("review.rate_first"));
          return null;
        }
        await api.post(`/api/items/${question.item}/rating`, { reviewer: reviewer(), rating: told.value, flags: chosen, comment: comment.value });
        return next();
      });
    };
    const meaning = question.meaning.replaceAll("_", " ");
    const again = question.kind === "sign" ? h("a", { class: "button", href: `#teach/${encodeURIComponent(question.meaning)}` }, t("review.record")) : null;
    return [
      heading(question),
      h("p", {}, t("review.you_said", { understood: question.understood.replaceAll("_", " ") || t("review.nothing") })),
      h("p", { class: "meaning" }, t("review.it_is", { meaning })),
      h("form", { class: "stack", on: { submit } }, rating, flags, field(t("review.comment"), comment),
        h("div", { class: "row" }, h("button", { type: "submit", class: "primary" }, t("review.next")), again)),
    ];
  }
  return () => view?.remove();
}

function option(type, name, value, words) {
  const id = `${name}-${value}`;
  return h("label", { class: "tick", for: id }, h("input", { type, name, value, id }), h("span", {}, words));
}
