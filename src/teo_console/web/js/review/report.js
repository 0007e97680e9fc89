// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What a series says: shares with their intervals, what was taken for what, agreement, and published figures beside.

import { h } from "../dom.js";

const percent = (share) => `${Math.round(100 * share)}\u00a0%`;
const NOTHING = "–";

export async function report(element, { api, t, attempt }, series) {
  const told = await attempt(() => api.get(`/api/series/${series}/report`));
  if (!told) return;
  const share = (interval) => (interval ? `${percent(interval[0])} (${percent(interval[1])}–${percent(interval[2])})` : NOTHING);
  const alpha = (value) => (value === null ? NOTHING : value.toFixed(2));
  const counts = (map, key) => Object.entries(map).map(([name, count]) => `${key ? t(`${key}.${name}`) : name.replaceAll("_", " ") || t("review.nothing")} ×${count}`).join(", ") || NOTHING;
  const facts = [
    ["report.reviewers", String(told.reviewers)], ["report.answers", String(told.answers)], ["report.recognised", share(told.recognised)],
    ["report.majority", t("report.of", { part: told.recognised_by_majority, all: told.items.length })],
    ["report.agreement", alpha(told.agreement)], ["report.agreement_understood", alpha(told.agreement_understood)],
  ];
  const all = {
    share: (item) => share(item.recognised), taken_for: (item) => counts(item.taken_for), ratings: (item) => counts(item.ratings, "rating"),
    flags: (item) => counts(item.flags, "flag"), comments: (item) => item.comments.join(" · ") || NOTHING,
  };
  // A comprehension test has neither ratings nor comments.
  const columns = Object.keys(all).filter((name) => told.items.some((item) => all[name](item) !== NOTHING));
  const rows = told.items.map((item) => h("tr", {},
    h("th", { scope: "row" }, item.meaning.replaceAll("_", " ")), ...columns.map((name) => h("td", {}, all[name](item)))));
  element.append(
    h("p", {}, h("a", { href: "#review" }, t("review.back"))),
    h("section", { class: "card stack", "aria-labelledby": "report-title" },
      h("h2", { id: "report-title" }, t("review.report")),
      h("dl", {}, ...facts.flatMap(([key, value]) => [h("dt", {}, t(key)), h("dd", {}, value)])),
      h("p", { class: "faint" }, t("report.explained")),
      h("div", { class: "wide", tabindex: "0", role: "region", "aria-label": t("report.table") }, h("table", {}, h("thead", {}, h("tr", {}, ...["meaning", ...columns].map((name) => h("th", { scope: "col" }, t(`report.${name}`))))), h("tbody", {}, ...rows))),
      h("h3", {}, t("report.anchors")),
      h("ul", { class: "plain" }, ...told.anchors.map(({ name, source }) => h("li", {}, `${t(`anchor.${name}`)}: ${source}`)))),
  );
}
