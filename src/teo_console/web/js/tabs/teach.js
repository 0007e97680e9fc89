// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0

import { h } from "../dom.js";

export function mount(element, { t }) {
  element.append(h("h1", {}, t("tab.teach")));
}
