// What the drawings have in common: sharp pixels, colours of the style sheet, numbers with units.

const colors = new Map();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => colors.clear());

/// A colour of page.css by its name.
export function color(name) {
  if (!colors.has(name)) {
    colors.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
  }
  return colors.get(name);
}

/// An empty canvas in CSS pixels: its context, width and height.
export function cleared(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = "12px system-ui, sans-serif";
  context.lineJoin = "round";
  return {context, width, height};
}

const LONGEST_ARC = 2;  // rad, of the shaft, from one sample to the next

/// The duration of an orbit that is shown, about three turns of the shaft [s].
export function orbitTime(speed) {
  return Math.min(3, Math.max(0.05, 3 * 2 * Math.PI / Math.max(1e-3, Math.abs(speed))));
}

/// Adds the line through samples {time, rate, speed} to the path; at(sample, k) is on the screen, k seconds along its rate.
/// With rates it is a curve; samples too far apart for that are dots.
export function curve(context, samples, at) {
  samples.forEach((one, i) => {
    const before = samples[i - 1];
    const third = before ? (one.time - before.time) / 3 : 0;
    if (!before || !one.rate) {
      context.lineTo(...at(one, 0));
    } else if (3 * third * Math.abs(one.speed) < LONGEST_ARC) {
      context.bezierCurveTo(...at(before, third), ...at(one, -third), ...at(one, 0));
    } else {
      const [x, y] = at(one, 0);
      context.moveTo(x + 1, y);
      context.arc(x, y, 1, 0, 2 * Math.PI);
      context.moveTo(x, y);
    }
  });
}

/// Scale and prefix for values up to `largest` of a unit: micrometres for small lengths.
export function scaleOf(largest, unit) {
  if (unit === "m" && largest > 0 && largest < 0.1) {
    return largest < 1e-4 ? {factor: 1e6, unit: "µm"} : {factor: 1e3, unit: "mm"};
  }
  return {factor: 1, unit: unit === "-" ? "" : unit};
}

/// "12.35 mm"
export function quantity(value, unit, digits = 4) {
  if (value === null || value === undefined || !isFinite(value)) {
    return "–";
  }
  const scale = scaleOf(Math.abs(value), unit);
  return `${short(value * scale.factor, digits)} ${scale.unit}`.trim();
}

export function short(value, digits = 4) {
  return String(Number(value.toPrecision(digits)));
}

/// Round numbers from low to high, about `count`.
export function ticks(low, high, count) {
  const rough = (high - low) / Math.max(1, count);
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = decade * [1, 2, 5, 10].find(digit => digit * decade >= rough * 0.999);
  const all = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && all.length < 50; ++k) {
    all.push(k * step);
  }
  return all;
}
