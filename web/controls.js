// Sliders for numbers in their ranges. The server checks every value; what it refuses does not change.

import {short} from "./canvas.js";

const STEPS = 1000;
const APART = 100;  // ms, between values that are sent

/// Limits of a slider and its scale, from the range of the model and the value at the start.
function spanOf(range, value) {
  switch (range) {
    case "positive": return {low: value / 10, high: value * 10, logarithmic: true};
    case "not_negative": return {low: 0, high: value > 0 ? 4 * value : 1};
    case "count": return {low: 1, high: Math.max(10, 4 * value), whole: true};
    default: { const most = Math.max(2 * Math.abs(value), value === 0 ? 1 : 0); return {low: -most, high: most}; }
  }
}

let count = 0;

export class Slider {
  /// number: {unit, meaning, range or low and high, value}; change(value) sends it, and may promise an answer: none
  /// where it is refused.
  constructor(label, number, change) {
    this.change = change;
    this.span = number.low !== undefined ? number : spanOf(number.range, number.value);
    const id = `number-${++count}`;
    this.row = document.createElement("div");
    this.row.className = "slider";
    const name = Object.assign(document.createElement("label"), {htmlFor: id, textContent: label,
                                                               title: number.meaning ?? ""});
    this.range = Object.assign(document.createElement("input"), {type: "range", min: 0, max: STEPS, step: 1});
    this.range.setAttribute("aria-label", `${label} ${number.unit ?? ""}, slider`);
    this.number = Object.assign(document.createElement("input"), {type: "number", id, step: "any"});
    this.number.inputMode = "decimal";
    const unit = Object.assign(document.createElement("span"), {className: "unit",
                                                              textContent: number.unit === "-" ? "" : number.unit});
    this.row.append(name, this.range, this.number, unit);
    this.show(number.value);
    this.range.addEventListener("input", () => this.set(this.at(this.range.value / STEPS)));
    this.range.addEventListener("pointerdown", () => this.dragged = true);
    for (const end of ["pointerup", "pointercancel"]) {
      this.range.addEventListener(end, () => {
        this.dragged = false;
        setTimeout(() => this.show(this.known), 3 * APART);  // what the last value has led to
      });
    }
    this.number.addEventListener("input", () => this.editing = true);
    this.number.addEventListener("change", () => {
      this.editing = false;
      if (this.number.value !== "") {
        this.set(Number(this.number.value));
      }
    });
  }

  at(share) {
    const {low, high, logarithmic, whole} = this.span;
    const value = logarithmic ? low * (high / low) ** share : low + share * (high - low);
    return whole ? Math.round(value) : Number(value.toPrecision(4));
  }

  /// Sends a value at once, further ones at most ten times a second, the newest at last.
  set(value) {
    this.number.value = short(value, 6);
    this.next = value;
    this.timer ??= setTimeout(async () => {
      this.timer = undefined;
      this.sent = performance.now();
      const sent = this.next;
      const answer = this.change(sent);
      if (answer) {
        this.show(await answer ? sent : this.known);
      }
    }, Math.max(0, (this.sent ?? -Infinity) + APART - performance.now()));
  }

  /// The value that the twin has.
  show(value) {
    this.known = value;
    if (this.timer !== undefined || this.editing || this.dragged) {
      return;
    }
    const {low, high, logarithmic} = this.span;
    const share = logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    this.range.value = Math.round(STEPS * Math.min(1, Math.max(0, share)));
    this.range.setAttribute("aria-valuetext", short(value, 6));
    this.number.value = short(value, 6);
  }
}

/// A part that opens, with a title and a grid of rows.
export function group(title, rows, open = false) {
  const details = document.createElement("details");
  details.open = open;
  const grid = document.createElement("div");
  grid.className = "sliders";
  grid.append(...rows);
  details.append(Object.assign(document.createElement("summary"), {textContent: title}), grid);
  return details;
}
