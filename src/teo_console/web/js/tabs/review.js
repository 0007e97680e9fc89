// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Review: series of signs and sentences for signers to judge. #review lists them, #review/SERIES is one of them,
// #review/SERIES/report what was said in it.

import { h } from "../dom.js";
import { overview } from "../review/overview.js";
import { questions } from "../review/questions.js";
import { report } from "../review/report.js";

export async function mount(element, context) {
  const { t } = context;
  const [, series, page] = location.hash.slice(1).split("/");
  element.append(h("h1", {}, t("tab.review")));
  if (!series) return overview(element, context);
  return page === "report" ? report(element, context, series) : questions(element, context, series);
}
