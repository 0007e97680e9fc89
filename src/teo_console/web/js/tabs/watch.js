// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0

import { h } from "../dom.js";

export async function mount(element, { robotView, t }) {
  const stage = h("div", {});
  stage.style.height = "60vh";
  element.append(h("h1", {}, t("tab.watch")), stage);
  const view = await robotView(stage);
  return () => view.remove();
}
