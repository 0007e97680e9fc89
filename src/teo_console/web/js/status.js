// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// How things are, in one sentence: the worst first.

import { has, t } from "./i18n.js";

/**
 * Says how things are.
 * @param {boolean} connected Whether the console answers.
 * @param {?Object} situation
 * @returns {{text: string, tone: "good"|"warn"|"bad", said: ?string}} `said` are a node's own words, in English.
 */
export function statusOf(connected, situation) {
  if (!connected || !situation) return { text: t("status.no_console"), tone: "bad" };
  const { nodes, robot, current, queue } = situation;
  const gone = nodes.filter(({ state }) => state === "missing" || state === "silent");
  if (gone.length) {
    const named = gone.map((node) => t(`status.${node.state}`, { node: t(`node.${node.role}`), quiet: node.quiet }));
    return { text: named.join(" "), tone: "bad" };
  }
  if (robot.mode === "stopped") return { text: t("status.stopped"), tone: "bad" };
  if (robot.mode === "fault" || robot.executor === "fault") {
    return { text: t("status.fault", { why: why(robot) }), tone: "bad" };
  }
  if (robot.mode === "inactive") return { text: t("status.inactive"), tone: "warn" };
  if (robot.mode === "paused") return { text: t("status.paused"), tone: "warn" };
  const unwell = nodes.find(({ state }) => state === "unwell");
  const signing = current ? t("status.signing", { text: current.text || t("untitled") }) : null;
  if (unwell) {
    const text = t("status.unwell", { node: t(`node.${unwell.role}`) });
    return { text: signing ? `${signing} ${text}` : text, tone: "warn", said: unwell.message };
  }
  if (signing) return { text: signing, tone: "good" };
  if (robot.executor === "waiting" && queue.length) return { text: t("status.waiting"), tone: "good" };
  if (robot.mode === "moving") return { text: t("status.moving"), tone: "good" };
  return { text: t("status.ready"), tone: "good" };
}

function why(robot) {
  const code = robot.executor === "fault" ? robot.executor_code : "";
  if (has(`code.${code}`)) return t(`code.${code}`);
  return robot.mode === "fault" ? robot.message : robot.executor_message;
}

/** A refusal in the user's language, or as it was said. */
export function refusalText(code, message) {
  return has(`code.${code}`) ? t(`code.${code}`, { message }) : message;
}
