// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// How a sign stands at each gate: a picture, words, and what to do.

import { drawing, h } from "../dom.js";
import { figure, t } from "../i18n.js";

/** Every gate of a capture. */
export const GATES = ["much_lost", "no_rest", "too_short", "palm_off", "contact_off", "place_off", "wrong_place", "too_slow"];
// What a figure is said in: centimetres instead of millimetres, hundredths instead of the whole.
const SCALE = { contact_off: 0.1, place_off: 0.1, wrong_place: 100 };

/**
 * A list of the gates, those that speak against the sign first.
 * @param {{code: string, passed: ?boolean, got: ?number, bound: ?number, at: ?number}[]} gates `passed` is null before a
 *   capture; `got` is the figure and `bound` what it may be; `at` is the second of the recording at which it is worst,
 *   where there is one.
 * @param {?function(number)} look Shows that second.
 */
export function gateList(gates, look = null) {
  const sorted = [...gates].sort((a, b) => a.passed - b.passed);
  return h("ul", { class: "gates" }, ...sorted.map((each) => gate(each, look)));
}

function gate({ code, passed, got, bound, at }, look) {
  const scaled = (value) => figure(Number((value * (SCALE[code] ?? 1)).toPrecision(2)), 2);
  const when = at != null && t("gate.at", { at: figure(at) });
  const failed = passed === false;
  const mark = passed === null ? "" : passed ? "✓ " : "✗ ";
  return h("li", { class: `gate ${passed === null ? "" : failed ? "failed" : "passed"}`, dataset: { gate: code } },
    drawing(`/gates.svg#${code}`, { viewBox: "0 0 48 48", "aria-hidden": "true" }),
    h("div", {},
      h("strong", {}, `${mark}${t(`gate.${code}`)}`),
      passed === null ? null : h("span", { class: "visually-hidden" }, t(failed ? "gate.failed" : "gate.passed")),
      got != null && h("p", {}, t(`gate.${code}.got`, { got: scaled(got), bound: scaled(bound) })),
      when && (look ? h("button", { type: "button", class: "quiet", on: { click: () => look(at) } }, when) : h("p", {}, when)),
      passed ? null : h("p", {}, t(`gate.${code}.remedy`))));
}
