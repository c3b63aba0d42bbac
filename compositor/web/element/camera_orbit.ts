// Text form of orbits, as <model-viewer> has it: "THETA PHI RADIUS".

import type { Orbit } from "./core.js";

const kDegree = Math.PI / 180;

/** An angle such as "30deg" or "0.5rad", in radians; undefined if it is none. */
export function parseAngle(text: string): number | undefined {
  const found = /^(-?[\d.]+)(deg|rad)$/.exec(text);
  const value = Number(found?.[1]);
  if (!found || !Number.isFinite(value)) return undefined;
  return found[2] === "deg" ? value * kDegree : value;
}

/**
 * Parses "THETA PHI RADIUS": the angle about the vertical axis, the angle from the vertical, and the distance in percent
 * of the captured one.
 * @param auto values of the word "auto"
 * @returns undefined if the text is none
 */
export function parseOrbit(text: string, captured: Orbit, auto = captured): Orbit | undefined {
  const [theta, phi, radius, ...rest] = text.trim().split(/\s+/);
  if (!radius || rest.length > 0) return undefined;
  const azimuth = theta === "auto" ? auto.azimuth : parseAngle(theta);
  const polar = phi === "auto" ? Math.PI / 2 - auto.elevation : parseAngle(phi);
  const percent = /^[\d.]+%$/.test(radius) ? Number.parseFloat(radius) : undefined;
  const distance = radius === "auto" ? auto.distance : percent && (captured.distance * percent) / 100;
  if (azimuth === undefined || polar === undefined || !distance) return undefined;
  return { azimuth, elevation: Math.PI / 2 - polar, distance };
}

/** The inverse of parseOrbit(). */
export function formatOrbit(view: Orbit, captured: Orbit): string {
  const degrees = (angle: number) => `${Number((angle / kDegree).toFixed(2))}deg`;
  const percent = Number(((100 * view.distance) / captured.distance).toFixed(2));
  return `${degrees(view.azimuth)} ${degrees(Math.PI / 2 - view.elevation)} ${percent}%`;
}

/** Descriptions of sides by the keys of the attribute `a11y`, such as "front" and "upper-back-left". */
export type SideDescriptions = Record<string, string>;

/** The side that a view shows, in words, for screen readers. */
export function describeView(view: Orbit, captured: Orbit, descriptions: SideDescriptions = {}): string {
  const sides = ["front", "front-right", "right", "back-right", "back", "back-left", "left", "front-left"];
  const turn = (view.azimuth - captured.azimuth) / (2 * Math.PI);
  const side = sides[((Math.round(turn * 8) % 8) + 8) % 8];
  const above = view.elevation - captured.elevation;
  const height = above > 8 * kDegree ? "upper" : above < -8 * kDegree ? "lower" : "";
  const given = descriptions[height ? `${height}-${side}` : side] ?? descriptions[side];
  if (given) return given;
  const words = { upper: ", from higher", lower: ", from lower", "": "" };
  return `View from the ${side.replace("-", " ")}${words[height]}`;
}

/** Parses the attribute `a11y`, a JSON object of texts; undefined if it is none. */
export function parseDescriptions(text: string): SideDescriptions | undefined {
  try {
    const value: unknown = JSON.parse(text);
    if (value && typeof value === "object" && Object.values(value).every((each) => typeof each === "string")) {
      return value as SideDescriptions;
    }
  } catch {
    // no JSON
  }
  return undefined;
}
