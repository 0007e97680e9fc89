// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// How a sign stands at each gate: a picture, words, and what to do.

import { h } from "../dom.js";
import { t } from "../i18n.js";

const SVG = "http://www.w3.org/2000/svg";

/** Every gate of a capture. */
export const GATES = ["much_lost", "no_rest", "too_short", "palm_off", "contact_off", "wrong_place", "too_slow"];

/**
 * A list of the gates, those that speak against the sign first.
 * @param {{code: string, passed: ?boolean, at: ?number}[]} gates `passed` is null before a capture; `at` is the
 *   second of the recording at which it is worst, where there is one.
 */
export function gateList(gates) {
  const sorted = [...gates].sort((a, b) => a.passed - b.passed);
  return h("ul", { class: "gates" }, ...sorted.map(gate));
}

function gate({ code, passed, at }) {
  const failed = passed === false;
  const mark = passed === null ? "" : passed ? "✓ " : "✗ ";
  return h("li", { class: `gate ${passed === null ? "" : failed ? "failed" : "passed"}`, dataset: { gate: code } },
    picture(code),
    h("div", {},
      h("strong", {}, `${mark}${t(`gate.${code}`)}`),
      passed === null ? null : h("span", { class: "visually-hidden" }, t(failed ? "gate.failed" : "gate.passed")),
      failed && at != null ? h("p", {}, t("gate.at", { at: at.toFixed(1) })) : null,
      passed ? null : h("p", {}, t(`gate.${code}.remedy`))));
}

function picture(code) {
  const drawing = document.createElementNS(SVG, "svg");
  drawing.setAttribute("viewBox", "0 0 48 48");
  drawing.setAttribute("aria-hidden", "true");
  const use = document.createElementNS(SVG, "use");
  use.setAttribute("href", `/gates.svg#${code}`);
  drawing.append(use);
  return drawing;
}
