// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The terms under which a sign is kept, and the buttons that keep it.

import { field, h } from "../dom.js";
import { refusalText } from "../status.js";

const LICENCES = ["CC-BY-4.0", "CC-BY-SA-4.0", "CC0-1.0", "for this laboratory alone"];

/** The form; when the sign is in the table it becomes a button that has TEO sign it. */
export function acceptForm(context, { gloss, hands, exists, failed, recording, progress, redo, forget }) {
  const { api, socket, t, attempt, notify } = context;
  const name = gloss.replaceAll("_", " ");
  const licence = h("select", { id: "accept-licence" }, ...LICENCES.map((each) => h("option", { value: each }, t(`licence.${each}`))));
  const person = h("input", { type: "text", id: "accept-person", maxlength: "60", autocomplete: "off" });
  const consent = box("accept-consent", t("teach.consent"));
  const keep = box("accept-keep", t("teach.keep"));
  const despite = box("accept-despite", t("teach.despite"));
  const replace = box("accept-replace", t("teach.replace", { name }));
  const needed = [consent, ...(failed.length ? [despite] : []), ...(exists ? [replace] : [])];
  const accept = h("button", { type: "submit", class: "primary" }, t("teach.accept"));

  async function submit(event) {
    event.preventDefault();
    const missing = needed.find(({ input }) => !input.checked);
    if (missing) {
      missing.input.focus();
      notify(t("teach.tick"));
      return;
    }
    await attempt(async () => {
      const told = await progress.finish(await api.post(`/api/recordings/${recording}/accept`, {
        gloss, hands, licence: licence.value, consent: consent.input.checked, person: person.value,
        despite_gates: despite.input.checked, replace: replace.input.checked,
      }));
      if (told.code !== "captured") {
        notify(refusalText(told.code));
        return;
      }
      if (keep.input.checked) await api.post(`/api/recordings/${recording}/keep`, { gloss });
      await forget();
      const sign = () => attempt(() => socket.ask("sign_glosses", { glosses: [gloss] }));
      form.replaceChildren(
        h("p", { role: "status", id: "accepted" }, t("teach.accepted", { name, standing: t(`evidence.${told.standing}`) })),
        h("div", { class: "row" }, h("button", { type: "button", class: "primary", on: { click: sign } }, t("teach.sign_it")), redo),
      );
      form.querySelector("button").focus();
    });
  }

  const form = h(
    "form", { class: "stack", on: { submit } },
    h("h3", {}, t("teach.terms")),
    h("div", { class: "fields" }, field(t("teach.licence"), licence), field(t("teach.person"), person)),
    ...needed.map(({ element }) => element), keep.element,
    h("div", { class: "row" }, accept, redo),
  );
  return form;
}

function box(id, words) {
  const input = h("input", { type: "checkbox", id });
  return { input, element: h("label", { class: "tick", for: id }, input, h("span", {}, words)) };
}
