// Traces over the last seconds of simulated time, one strip for each unit, and orbits.

import {cleared, color, curve, orbitTime, quantity, scaleOf, short, ticks} from "./canvas.js";

const WINDOW = 10;         // s, simulated
const MOST = 20000;        // samples of a line
const STRIP_HEIGHT = 110;  // px
const LEFT = 62, RIGHT = 8, TOP = 16, BOTTOM = 20;

export class Traces {
  /// lines: [{name, unit}], in the order of the values.
  constructor(canvas, lines) {
    this.canvas = canvas;
    this.lines = lines.map(line => ({...line, values: []}));
    this.time = [];
    const units = [...new Set(lines.map(line => line.unit))];
    this.strips = units.map(unit => ({unit, lines: this.lines.filter(line => line.unit === unit)}));
    canvas.style.height = `${this.strips.length * STRIP_HEIGHT}px`;
  }

  /// values: one array for each line.
  take(time, values) {
    if (time.length && this.time.length && time[0] < this.time[this.time.length - 1]) {
      this.time.length = 0;  // the twin was reset
      this.lines.forEach(line => line.values.length = 0);
    }
    this.time.push(...time);
    this.lines.forEach((line, i) => line.values.push(...values[i]));
    const end = this.time[this.time.length - 1];
    let old = Math.max(0, this.time.length - MOST);
    while (old < this.time.length && this.time[old] < end - WINDOW) {
      ++old;
    }
    if (old > 500 || this.time.length > MOST) {
      this.time.splice(0, old);
      this.lines.forEach(line => line.values.splice(0, old));
    }
  }

  draw() {
    const {context, width} = cleared(this.canvas);
    const end = Math.max(WINDOW, this.time[this.time.length - 1] ?? 0);
    const across = time => LEFT + (time - end + WINDOW) / WINDOW * (width - LEFT - RIGHT);
    this.strips.forEach((strip, i) => this.strip(context, strip, i * STRIP_HEIGHT, width, end, across));
    const newest = this.lines.map(line => `${line.name} ${quantity(line.values[line.values.length - 1], line.unit)}`);
    this.canvas.setAttribute("aria-label", `traces: ${newest.join(", ")}`);
  }

  strip(context, strip, top, width, end, across) {
    let low = Infinity, high = -Infinity;
    for (const line of strip.lines) {
      line.values.forEach((value, k) => {
        if (value !== null && this.time[k] >= end - WINDOW) {
          low = Math.min(low, value);
          high = Math.max(high, value);
        }
      });
    }
    if (!(low <= high)) {
      [low, high] = [0, 1];
    }
    const least = 1e-9 + 1e-3 * Math.max(Math.abs(low), Math.abs(high));
    if (high - low < least) {
      [low, high] = [(low + high - least) / 2, (low + high + least) / 2];
    }
    const room = 0.06 * (high - low);
    [low, high] = [low - room, high + room];
    const bottom = top + STRIP_HEIGHT - BOTTOM;
    const up = value => bottom - (value - low) / (high - low) * (bottom - top - TOP);
    const scale = scaleOf(Math.max(Math.abs(low), Math.abs(high)), strip.unit);
    context.strokeStyle = color("grid");
    context.fillStyle = color("faint");
    context.lineWidth = 1;
    context.textAlign = "right";
    const marks = ticks(low * scale.factor, high * scale.factor, 3);
    const apart = marks.length > 1 ? marks[1] - marks[0] : 1;
    const digits = Math.max(4, Math.ceil(Math.log10(Math.max(...marks.map(Math.abs), apart) / apart)) + 1);
    for (const tick of marks) {
      const y = up(tick / scale.factor);
      context.beginPath();
      context.moveTo(LEFT, y);
      context.lineTo(width - RIGHT, y);
      context.stroke();
      context.fillText(short(tick, Math.min(12, digits)), LEFT - 5, y + 4);
    }
    context.textAlign = "center";
    for (const tick of ticks(end - WINDOW, end, width / 110)) {
      context.fillText(`${short(tick)} s`, Math.min(across(tick), width - 18), bottom + 14);
    }
    context.textAlign = "left";
    let at = LEFT;
    strip.lines.forEach((line, i) => {
      const label = `${line.name} (${scale.unit || "-"})`;
      context.fillStyle = color(`line-${i % 4 + 1}`);
      context.fillText(label, at, top + 11);
      at += context.measureText(label).width + 14;
      this.line(context, line, color(`line-${i % 4 + 1}`), across, up);
    });
  }

  /// The lowest and the highest value in each column of pixels.
  line(context, line, style, across, up) {
    context.strokeStyle = style;
    context.lineWidth = 1.5;
    context.beginPath();
    let column = -1, low, high, broken = true;
    const put = () => {
      if (column >= LEFT) {
        broken ? context.moveTo(column, up(low)) : context.lineTo(column, up(low));
        context.lineTo(column, up(high));
        broken = false;
      }
    };
    line.values.forEach((value, k) => {
      if (value === null) {
        put();
        [column, broken] = [-1, true];
        return;
      }
      const x = Math.round(across(this.time[k]));
      if (x !== column) {
        put();
        [column, low, high] = [x, value, value];
      }
      low = Math.min(low, value);
      high = Math.max(high, value);
    });
    put();
    context.stroke();
  }
}

export class Orbit {
  constructor(canvas, name) {
    this.canvas = canvas;
    this.name = name;
    this.points = [];  // {time, at, rate, speed}
  }

  take(samples) {
    const [x, y, xRate, yRate] = samples.values;
    samples.time.forEach((time, i) => x[i] !== null && y[i] !== null && this.points.push(
      {time, at: [x[i], y[i]], rate: [xRate[i], yRate[i]], speed: samples.speed[i]}));
    const {time: end, speed} = this.points[this.points.length - 1] ?? {time: 0, speed: 0};
    this.points = this.points.filter(one => one.time <= end && one.time >= end - orbitTime(speed)).slice(-3000);
  }

  draw() {
    const {context, width, height} = cleared(this.canvas);
    const largest = this.points.reduce((most, one) => Math.max(most, Math.hypot(...one.at)), 0);
    // Calm: the scale changes by a fifth or more.
    if (!(largest <= this.range && largest > 0.6 * this.range)) {
      this.range = 1.2 * largest || 1e-6;
    }
    const scale = 0.42 * Math.min(width, height) / this.range;
    const [middle, centre] = [width / 2, height / 2];
    context.strokeStyle = color("grid");
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(0, centre);
    context.lineTo(width, centre);
    context.moveTo(middle, 0);
    context.lineTo(middle, height);
    context.stroke();
    const unit = scaleOf(this.range, "m");
    const circle = ticks(0, this.range * unit.factor, 3).filter(tick => tick > 0).pop() ?? 0;
    context.beginPath();
    context.arc(middle, centre, circle / unit.factor * scale, 0, 2 * Math.PI);
    context.stroke();
    context.strokeStyle = color("line-1");
    context.lineWidth = 1.5;
    context.beginPath();
    const at = (one, k) => [middle + scale * (one.at[0] + k * one.rate[0]), centre - scale * (one.at[1] + k * one.rate[1])];
    curve(context, this.points, at);
    context.stroke();
    const last = this.points[this.points.length - 1];
    if (last) {
      context.fillStyle = color("mark");
      context.beginPath();
      context.arc(...at(last, 0), 4, 0, 2 * Math.PI);
      context.fill();
    }
    context.fillStyle = color("faint");
    context.fillText(`orbit, circle ${short(circle)} ${unit.unit}`, 8, 16);
    this.canvas.setAttribute("aria-label", `${this.name}, orbit, largest radius ${quantity(largest, "m")}`);
  }
}
