// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The series that there are, a form for a new one, and exports of all that was said.

import { field, h } from "../dom.js";
import { JobProgress } from "../parts/jobs.js";
import { glossOf } from "../parts/word_field.js";

export async function overview(element, context) {
  const { api, t, attempt } = context;
  const list = h("ul", { class: "series" });
  async function refresh() {
    const series = (await attempt(() => api.get("/api/series"))) ?? [];
    list.replaceChildren(...series.map((each) => row(context, each)));
    if (!series.length) list.append(h("li", { class: "faint" }, t("review.no_series")));
  }
  await refresh();
  element.append(
    h("div", { class: "two" },
      h("section", { class: "card stack", "aria-labelledby": "series-title" }, h("h2", { id: "series-title" }, t("review.series")), h("p", {}, t("review.invitation")), list, exports(context)),
      newSeries(context, refresh)),
  );
}

function row({ t, notify }, { id, kind, title, items, reviewers, created }) {
  const address = `#review/${id}`;
  const link = new URL(address, location.href).href;
  // Over plain http a browser on another machine gives no clipboard: then the link is shown.
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(link);
      notify(t("review.copied"));
    } catch {
      notify(link);
    }
  };
  const name = title || `${t(`review.${kind}`)} · ${created.slice(0, 10)}`;
  return h("li", { dataset: { series: id } },
    h("div", {}, h("strong", {}, name), h("p", { class: "faint" }, `${t(`review.${kind}`)} · ${t("review.count", { items, reviewers })}`)),
    h("div", { class: "row" },
      h("a", { class: "button primary", href: address, "aria-label": t("review.open_label", { name }) }, t("review.open")),
      h("a", { class: "button", href: `${address}/report`, "aria-label": t("review.report_label", { name }) }, t("review.report")),
      h("button", { type: "button", "aria-label": t("review.copy_label", { name }), on: { click: copy } }, t("review.copy"))));
}

function exports({ api, t, attempt, notify }) {
  const progress = new JobProgress(api);
  const said = h("section", { class: "stack", "aria-live": "polite", id: "entered" });
  const enter = () => attempt(async () => {
    progress.begin("enter");
    const { signs, changed } = await api.post("/api/reviews/enter").finally(() => progress.end());
    said.replaceChildren(
      h("h4", {}, t("review.entered")),
      h("p", {}, t("review.entered_count", { rated: signs.length, changed })),
      h("ul", { class: "plain" }, ...signs.map((sign) => h("li", {}, h("strong", {}, sign.gloss.replaceAll("_", " ")), `: ${verdict(t, sign)}`))),
    );
    notify(t("review.entered"));
  });
  return h("div", { class: "stack" },
    h("h3", {}, t("review.exports")),
    h("div", { class: "row" },
      h("a", { class: "button", href: "/api/reviews.json", download: "reviews.json" }, "JSON"),
      h("a", { class: "button", href: "/api/reviews.csv", download: "reviews.csv" }, "CSV"),
      h("button", { type: "button", on: { click: enter } }, t("review.enter"))),
    h("p", { class: "faint" }, t("review.rule")), progress.element, said);
}

/** What the ratings made of a sign. */
function verdict(t, { standing, right, reviewers }) {
  if (standing === null) return t("review.no_such_sign");
  return `${t(`evidence.${standing}`)} (${t("review.of_people", { right, reviewers })})`;
}

function newSeries({ api, t, attempt, notify }, refresh) {
  const progress = new JobProgress(api);
  const signs = attempt(() => api.get("/api/signs")).then((all) => all ?? []);
  const kind = h("select", { id: "new-kind" }, ...["review", "comprehension"].map((name) => h("option", { value: name }, t(`review.${name}`))));
  const title = h("input", { type: "text", id: "new-title", maxlength: "100", autocomplete: "off" });
  const glosses = h("textarea", { id: "new-glosses", rows: "3" });
  const sentences = h("textarea", { id: "new-sentences", rows: "3" });
  const choices = h("select", { id: "new-choices" }, h("option", { value: "yes" }, t("review.choices")), h("option", { value: "" }, t("review.free")));
  async function submit(event) {
    event.preventDefault();
    await attempt(async () => {
      const wanted = glosses.value.split(/[\n,;]+/).map((each) => each.trim()).filter(Boolean);
      const known = new Set((await signs).map(({ gloss }) => gloss));
      const unknown = wanted.filter((each) => !known.has(glossOf(each)));
      if (unknown.length) {
        glosses.focus();
        notify(t("review.unknown", { words: unknown.join(", ") }));
        return;
      }
      const { preparation } = await api.post("/api/series", {
        kind: kind.value, title: title.value, choices: Boolean(choices.value), glosses: wanted,
        sentences: sentences.value.split("\n").map((each) => each.trim()).filter(Boolean),
      });
      await progress.prepared(preparation);
      notify(t("review.made"));
      await refresh();
    });
  }
  return h("form", { class: "card stack", "aria-labelledby": "new-title-words", on: { submit } },
    h("h2", { id: "new-title-words" }, t("review.new")),
    field(t("review.kind"), kind), field(t("review.title"), title), field(t("review.glosses"), glosses),
    field(t("review.sentences"), sentences), field(t("review.how"), choices),
    h("div", { class: "row" }, h("button", { type: "submit" }, t("review.make"))), progress.element);
}
