// Draws the sketch of a system: bodies, springs, supports (src/mechanics/sketch.h), far parts first.
// Axes: x to the right, z up, y into the picture; a spatial one is seen from above and from the left.

import {cleared, color, curve, orbitTime, short} from "./canvas.js";

const CORNERS = 40;  // of a disc
const TRAIL = 1.5;   // s, simulated

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const n = Math.hypot(...a) || 1; return [a[0] / n, a[1] / n, a[2] / n]; };

export class SketchView {
  constructor(canvas, name) {
    this.canvas = canvas;
    this.name = name;
    this.azimuth = -0.6;
    this.elevation = 0.3;
    this.trail = [];
    this.listen();
  }

  listen() {
    this.canvas.addEventListener("pointermove", event => {
      if (event.buttons && this.picture?.sketch?.spatial) {
        this.turn(-0.01 * event.movementX, event.pointerType === "mouse" ? 0.01 * event.movementY : 0);
      }
    });
    this.canvas.addEventListener("keydown", event => {
      const turns = {ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]};
      if (turns[event.key] && this.picture?.sketch?.spatial) {
        event.preventDefault();
        this.turn(...turns[event.key]);
      }
    });
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.min(1.5, Math.max(-1.5, this.elevation + elevation));
    this.draw();
  }

  take(picture) {
    if (this.picture && (picture.time < this.picture.time || picture.magnification !== this.picture.magnification)) {
      this.trail = [];
    }
    this.picture = picture;
    const {time, path, values, speed} = picture.samples, rotor = picture.names.includes("x_rate");
    path.forEach((at, i) => this.trail.push(
      {time: time[i], at, speed: speed[i],
       rate: rotor && [0, picture.magnification * values[2][i], picture.magnification * values[3][i]]}));
    const old = this.trail.findIndex(one => one.time >= picture.time - (rotor ? orbitTime(picture.speed) : TRAIL));
    this.trail.splice(0, old < 0 ? this.trail.length : old);
  }

  draw() {
    const {context, width, height} = cleared(this.canvas);
    const picture = this.picture;
    if (!picture?.sketch) {
      context.fillStyle = color("faint");
      context.fillText(picture?.stopped ? "stopped" : picture ? "no drawing of this model" : "", 10, 20);
      this.canvas.setAttribute("aria-label", `${this.name}: ${picture?.stopped || "no drawing"}`);
      return;
    }
    const sketch = picture.sketch;
    const azimuth = sketch.spatial ? this.azimuth : 0, elevation = sketch.spatial ? this.elevation : 0;
    const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
    const tall = sketch.height || sketch.size;
    const scale = 0.94 * Math.min(width / sketch.size, height / (tall * ce + 0.5 * sketch.size * Math.abs(se)));
    this.scale = scale;
    this.project = point => {
      const [x, y, z] = sub(point, sketch.centre);
      const across = x * ca + y * sa, into = y * ca - x * sa;
      return [width / 2 + scale * across, height / 2 - scale * (z * ce + into * se), into * ce - z * se];
    };
    const parts = [];
    const part = (points, paint) => {
      const depth = points.reduce((sum, point) => sum + this.project(point)[2], 0) / points.length;
      parts.push({depth, paint});
    };
    sketch.lines.forEach(one => parts.push({depth: Infinity, paint: () => this.line(context, one)}));
    sketch.boxes.forEach(one => part([one.at], () => this.box(context, one)));
    sketch.rods.forEach(one => part([one.from, one.to], () => this.rod(context, one)));
    sketch.springs.forEach(one => part([one.from, one.to], () => this.spring(context, one)));
    sketch.dampers.forEach(one => part([one.from, one.to], () => this.damper(context, one)));
    sketch.discs.forEach(one => part([one.at], () => this.disc(context, one)));
    sketch.balls.forEach(one => part([one.at], () => this.ball(context, one)));
    parts.sort((a, b) => b.depth - a.depth).forEach(one => one.paint());
    context.beginPath();
    curve(context, this.trail, (one, k) => this.project(one.rate ? add(one.at, one.rate, k) : one.at).slice(0, 2));
    context.strokeStyle = color("line-4");
    context.lineWidth = 1.5;
    context.stroke();
    sketch.arrows.forEach(one => this.arrow(context, one));
    if (picture.magnification !== 1) {
      context.fillStyle = color("faint");
      context.fillText(`deflection × ${short(picture.magnification)}`, 8, 16);
    }
    this.canvas.setAttribute("aria-label", `${this.name}, drawing at ${short(picture.time)} s`);
  }

  /// Begins the path through these points.
  through(context, points) {
    context.beginPath();
    points.forEach(point => context.lineTo(...this.project(point).slice(0, 2)));
  }

  path(context, points, style, width) {
    this.through(context, points);
    context.strokeStyle = style;
    context.lineWidth = width;
    context.stroke();
  }

  polygon(context, points, style, edge = color("outline"), width = 1) {
    this.through(context, points);
    context.closePath();
    context.fillStyle = style;
    context.fill();
    context.strokeStyle = edge;
    context.lineWidth = width;
    context.stroke();
  }

  line(context, one) {
    this.path(context, one.points, color(one.role), 1.5);
  }

  rod(context, one) {
    const width = Math.max(2, 2 * one.radius * this.scale);
    const [from, to] = [this.project(one.from), this.project(one.to)];
    if (Math.hypot(to[0] - from[0], to[1] - from[1]) < 1) {
      return this.ball(context, {at: one.from, radius: one.radius, role: one.role});  // seen from its end
    }
    const along = sub(one.to, one.from);
    const length = Math.hypot(...along);
    if (this.picture.sketch.spatial && length < 2 * one.radius) {  // rather a ring than a rod
      return this.cylinder(context, {at: add(one.from, along, 0.5), axis: along, radius: one.radius, thickness: length},
                           color(one.role), color(one.role));
    }
    context.lineCap = width > 6 ? "butt" : "round";
    this.path(context, [one.from, one.to], color("outline"), width + 1.5);
    this.path(context, [one.from, one.to], color(one.role), width);
  }

  ball(context, one) {
    const [x, y] = this.project(one.at);
    const radius = Math.max(2, one.radius * this.scale);
    const shade = context.createRadialGradient(x - 0.4 * radius, y - 0.4 * radius, 0.1 * radius, x, y, radius);
    shade.addColorStop(0, color("card"));
    shade.addColorStop(0.35, color(one.role));
    shade.addColorStop(1, color(one.role));
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = shade;
    context.fill();
    context.strokeStyle = color("outline");
    context.lineWidth = 1;
    context.stroke();
  }

  disc(context, one) {
    const {rim, near} = this.cylinder(context, one, color(one.role), color("rim"));
    this.path(context, [add(one.at, unit(one.axis), near), rim(near, one.angle)], color("mark"), 3);
  }

  /// Returns points of its rim, by the distance along the axis and the angle, and which end is near.
  cylinder(context, one, face, side) {
    const axis = unit(one.axis);
    const start = Math.abs(axis[2]) > 0.9 ? [1, 0, 0] : [0, 0, 1];
    const first = unit(add(start, axis, -(start[0] * axis[0] + start[1] * axis[1] + start[2] * axis[2])));
    const second = cross(axis, first);
    const rim = (along, angle) => add(add(add(one.at, axis, along), first, one.radius * Math.cos(angle)),
                                      second, one.radius * Math.sin(angle));
    const half = one.thickness / 2;
    const near = this.project(add(one.at, axis, half))[2] < this.project(add(one.at, axis, -half))[2] ? half : -half;
    const circle = along => Array.from({length: CORNERS}, (_, k) => rim(along, 2 * Math.PI * k / CORNERS));
    const back = circle(-near), front = circle(near);
    this.polygon(context, back, side);
    for (let k = 0; k < CORNERS; ++k) {
      const next = (k + 1) % CORNERS;
      this.polygon(context, [back[k], back[next], front[next], front[k]], side, side, 0.5);
    }
    this.polygon(context, front, face);
    return {rim, near};
  }

  box(context, one) {
    const [cp, sp] = [Math.cos(one.pitch), Math.sin(one.pitch)];
    const corner = (i, j, k) => {
      const [x, y, z] = [i * one.size[0] / 2, j * one.size[1] / 2, k * one.size[2] / 2];
      return add(one.at, [x * cp - z * sp, y, x * sp + z * cp]);
    };
    const faces = [];
    for (const s of [-1, 1]) {
      faces.push([[s, -1, -1], [s, 1, -1], [s, 1, 1], [s, -1, 1]], [[-1, s, -1], [1, s, -1], [1, s, 1], [-1, s, 1]],
                 [[-1, -1, s], [1, -1, s], [1, 1, s], [-1, 1, s]]);
    }
    faces.map(face => face.map(each => corner(...each)))
      .map(points => ({points, depth: points.reduce((sum, point) => sum + this.project(point)[2], 0)}))
      .sort((a, b) => b.depth - a.depth)
      .forEach(face => this.polygon(context, face.points, color(one.role)));
  }

  spring(context, one) {
    const [x0, y0] = this.project(one.from), [x1, y1] = this.project(one.to);
    const length = Math.hypot(x1 - x0, y1 - y0) || 1;
    const radius = Math.max(3, one.radius * this.scale);
    const [nx, ny] = [-(y1 - y0) / length * radius, (x1 - x0) / length * radius];
    const turns = 9;
    context.beginPath();
    context.moveTo(x0, y0);
    for (let k = 0; k <= 2 * turns; ++k) {
      const share = 0.1 + 0.8 * k / (2 * turns), side = k === 0 || k === 2 * turns ? 0 : k % 2 ? 1 : -1;
      context.lineTo(x0 + share * (x1 - x0) + side * nx, y0 + share * (y1 - y0) + side * ny);
    }
    context.lineTo(x1, y1);
    context.strokeStyle = color("spring");
    context.lineWidth = 2;
    context.stroke();
  }

  damper(context, one) {
    const middle = k => add(one.from, sub(one.to, one.from), k);
    const width = Math.max(4, 2 * one.radius * this.scale);
    context.lineCap = "butt";
    this.path(context, [one.from, one.to], color("support"), 2);
    this.path(context, [middle(0.35), middle(0.65)], color("outline"), width + 2);
    this.path(context, [middle(0.35), middle(0.65)], color("support"), width);
  }

  arrow(context, one) {
    const [x0, y0] = this.project(one.from), [x1, y1] = this.project(one.to);
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 2) {
      return;
    }
    const [ux, uy] = [(x1 - x0) / length * 8, (y1 - y0) / length * 8];
    context.strokeStyle = context.fillStyle = color("mark");
    context.lineWidth = 2.5;
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1 - ux, y1 - uy);
    context.stroke();
    context.beginPath();
    context.moveTo(x1, y1);
    context.lineTo(x1 - ux - uy / 2, y1 - uy + ux / 2);
    context.lineTo(x1 - ux + uy / 2, y1 - uy - ux / 2);
    context.fill();
  }
}
