// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// How things are, in one sentence: the worst first.

import { has, t } from "./i18n.js";

/**
 * Says how things are.
 * @param {boolean} connected Whether the console answers.
 * @param {?Object} situation
 * @returns {{text: string, tone: "good"|"warn"|"bad"}}
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
    return { text: t("status.fault", { why: robot.executor === "fault" ? refusalText(robot.executor_code) : "" }).trim(), tone: "bad" };
  }
  if (robot.mode === "inactive") return { text: t("status.inactive"), tone: "warn" };
  if (robot.mode === "paused") return { text: t("status.paused"), tone: "warn" };
  if (current) return { text: t("status.signing", { text: current.text || t("untitled") }), tone: "good" };
  if (robot.executor === "waiting" && queue.length) return { text: t("status.waiting"), tone: "good" };
  if (robot.mode === "moving") return { text: t("status.moving"), tone: "good" };
  return { text: t("status.ready"), tone: "good" };
}

/** A refusal in the user's language, from its stable reason: what a node says of it is in English. */
export function refusalText(code) {
  return has(`code.${code}`) ? t(`code.${code}`) : t("code.other", { code });
}
