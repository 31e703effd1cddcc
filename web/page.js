// The page of a running twin: what it does, and what can be changed of it.

import {quantity, short} from "./canvas.js";
import {group, Slider} from "./controls.js";
import {Client} from "./foxglove.js";
import {Orbit, Traces} from "./plot.js";
import {SketchView} from "./sketch.js";

const HOLD = 1e6;  // s, simulated: how long an input keeps a value
const $ = id => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

let views = [];               // with draw()
const sliders = new Map();    // of parameters, by name
let paused = false, readOnly = false, hideMessage;
let alerts = [], unknown = "";  // active ones, or why they are not known

function showMessage(text) {
  $("message").textContent = text;
  $("message").hidden = false;
  clearTimeout(hideMessage);
  hideMessage = setTimeout(() => $("message").hidden = true, 12000);
}

const client = new Client(`ws://${location.host}/${location.search}`, {
  open(info) { readOnly = info.metadata?.read_only === "true"; },
  channels() {
    client.subscribe("scene", build);
    client.subscribe("loop", showLoop);
    client.subscribe("alerts", message => {
      alerts = message.alerts;
      showAlerts();
    });
    client.subscribe("server", counts => {
      $("counts").textContent =
        `clients: ${counts.clients}, messages sent: ${counts.sent}, lost by slow clients: ${counts.dropped}`;
      if (unknown !== counts.silence) {
        unknown = counts.silence;
        showAlerts();
      }
    });
    client.watchParameters();
  },
  close() {
    showState("lost", "disconnected");
    unknown = "no connection to the server";
    showAlerts();
  },
  status: showMessage,
  parameters(values) { values.forEach(one => sliders.get(one.name)?.show(one.value)); },
});

const call = (service, request = {}) => client.call(service, request).catch(error => showMessage(error.message));

function showState(kind, text) {
  $("state").className = `pill ${kind}`;
  $("state").textContent = text;
}

function showPaused(now, stopped = []) {
  paused = now;
  showState(paused ? "paused" : stopped.length ? "lost" : "running",
            paused ? "paused" : stopped.length ? `${stopped.join(", ")} stopped` : "running");
  $("pause").textContent = paused ? "Resume" : "Pause";
}

function showLoop(loop) {
  showPaused(loop.paused, loop.system.filter((_, i) => loop.stopped[i] !== 0));
  $("time").textContent = `${short(loop.time, 6)} s`;
  $("factor").textContent = loop.achieved_factor === null || paused ? "" : `× ${short(loop.achieved_factor, 3)}`;
}

// ---- Alarms

function sentenceOf(alert) {
  const about = alert.text.startsWith(alert.system) ? "" : `${alert.system}: `;
  return about + alert.text + (alert.latched ? " (latched)" : "");
}

function showAlerts() {
  const list = $("alarm-list");
  list.replaceChildren();
  if (unknown) {
    list.append(make("li", {}, make("span", {className: "severity WARNING", textContent: "UNKNOWN"}),
                     make("span", {textContent: `${unknown}; the alarms below are the last known ones`})));
  }
  for (const alert of alerts) {
    const severity = ["INFO", "WARNING", "DANGER"][alert.severity];
    const row = make("li", {className: alert.acknowledged ? "acknowledged" : ""},
                     make("span", {className: `severity ${severity}`, textContent: severity}),
                     make("span", {textContent: sentenceOf(alert)}));
    if (!readOnly && !alert.acknowledged) {
      const button = make("button", {type: "button", textContent: "Acknowledge"});
      button.addEventListener("click", () => call("acknowledge", {system: alert.system, type: alert.type}));
      row.append(button);
    }
    list.append(row);
  }
  if (!alerts.length && !unknown) {
    list.append(make("li", {className: "quiet", textContent: "none"}));
  }
  $("reset-alarms").hidden = readOnly || !alerts.length;
}

// ---- The scene

function build(scene) {
  document.title = $("scene").textContent = scene.name;
  $("run").hidden = readOnly;
  views = [];
  sliders.clear();
  $("systems").replaceChildren(...scene.systems.map(system => systemCard(system, scene)));
  fill("drives", scene.drives.filter(drive => !drive.motor && !readOnly).map(driveRow));
  fill("controllers", readOnly ? [] : scene.controllers.filter(one => one.parameters.length).map(
    one => parameterGroup(`${one.name} (${one.type})`, one.parameters)));
}

function fill(id, rows) {
  const title = $(id).querySelector("h2");
  $(id).replaceChildren(title, ...rows);
  $(id).hidden = !rows.length;
}

function parameterGroup(title, parameters) {
  return group(title, parameters.map(one => {
    const slider = new Slider(one.path, one, value => client.setParameter(one.name, value));
    sliders.set(one.name, slider);
    return slider.row;
  }));
}

function driveRow(drive) {
  const most = 1.25 * Math.max(Math.abs(drive.lowest), Math.abs(drive.highest)) || 100;
  const move = speed => call("set_speed", {drive: drive.name, speed, max_acceleration: drive.max_acceleration,
                                          max_jerk: drive.max_jerk});
  const slider = new Slider(`${drive.name}, target speed`,
                            {low: Math.min(0, 1.25 * drive.lowest), high: most, value: drive.speed, unit: "rad/s",
                             meaning: `at ${drive.max_acceleration} rad/s²`}, move);
  client.subscribe(`drives/${drive.name}`, state => slider.show(state.target_speed));
  return slider.row;
}

function inputGroup(system) {
  return group("Inputs", system.inputs.map(input => new Slider(
    input.name, {...input, range: "any"},
    value => call("set_input", {system: system.name, input: input.name, value, duration: HOLD})).row), true);
}

function systemCard(system, scene) {
  const sketchCanvas = make("canvas", {className: "sketch", tabIndex: 0});
  const traceCanvas = make("canvas", {className: "traces"});
  const orbitCanvas = make("canvas", {className: "orbit"});
  for (const canvas of [sketchCanvas, traceCanvas, orbitCanvas]) {
    canvas.setAttribute("role", "img");
  }
  const stability = make("p", {className: "stability quiet", textContent: "stability: not yet evaluated"});
  const pictures = make("div", {className: system.rotor ? "views two" : "views"}, sketchCanvas);
  if (system.rotor) {
    pictures.append(orbitCanvas);
  }
  const card = make("article", {}, make("h2", {textContent: `${system.name} `}, make("small", {textContent: system.model})),
                    pictures, traceCanvas, stability);
  if (!readOnly && system.inputs.length) {
    card.append(inputGroup(system));
  }
  if (!readOnly && !system.fixed && system.parameters.length) {
    card.append(parameterGroup("Parameters", system.parameters));
  }
  const lines = system.rotor ? [{name: "whirl radius", unit: "m"}]
                             : system.coordinates.map(one => ({name: one.name, unit: one.unit}));
  if (system.drive) {
    lines.push({name: "speed", unit: "rad/s"});
  }
  const sketch = new SketchView(sketchCanvas, system.name);
  const traces = new Traces(traceCanvas, lines.slice(0, 8));
  const orbit = system.rotor ? new Orbit(orbitCanvas, system.name) : undefined;
  views.push(sketch, traces, ...(orbit ? [orbit] : []));
  client.subscribe(`${system.name}/picture`, picture => {
    const {time, values, speed} = picture.samples;
    const shown = system.rotor ? [values[0].map((x, i) => x === null ? null : Math.hypot(x, values[1][i]))] : values;
    traces.take(time, system.drive ? [...shown, speed] : shown);
    orbit?.take(picture.samples);
    sketch.take(picture);
    $("time").textContent = `${picture.time.toFixed(2)} s`;
    schedule();
  });
  client.subscribe(`${system.name}/stability`, margin => showStability(stability, margin));
  return card;
}

function showStability(place, margin) {
  const parts = [];
  const add = (name, value, unit) => value !== null && parts.push(`${name} ${quantity(value, unit)}`);
  add("decay rate", margin.decay_rate, "1/s");
  add("damping ratio", margin.damping_ratio, "");
  add("unstable from", margin.instability_speed, "rad/s");
  if (margin.critical_speeds?.length) {
    parts.push(`critical speeds ${margin.critical_speeds.slice(0, 3).map(one => short(one.critical_speed, 4)).join(", ")} rad/s`);
  }
  if (margin.nearest_parameter) {
    parts.push(`lost at ${margin.nearest_parameter} = ${short(margin.nearest_value, 4)}`);
  }
  const verdict = margin.verdict_name.toLowerCase().replaceAll("_", " ");
  place.className = "stability";
  place.replaceChildren(make("strong", {className: verdict === "asymptotically stable" ? "good" : /unstable|no motion/.test(verdict) ? "bad" : "", textContent: verdict}),
                        parts.length ? `: ${parts.join(", ")}` : "");
}

// ---- Drawing, at the rate of the screen

let due = false;
function schedule() {
  if (!due) {
    due = true;
    requestAnimationFrame(() => {
      due = false;
      views.filter(view => isVisible(view.canvas)).forEach(view => view.draw());
    });
  }
}
function isVisible(canvas) {
  const {top, bottom} = canvas.getBoundingClientRect();
  return bottom > 0 && top < innerHeight;
}
addEventListener("resize", schedule);
addEventListener("scroll", schedule, {passive: true});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", schedule);

// ---- Run

$("pause").addEventListener("click", async () => {
  if (await call(paused ? "resume" : "pause")) {
    showPaused(!paused);
  }
});
$("step").addEventListener("click", () => call("step", {steps: Math.max(0, Math.round(Number($("steps").value)))}));
$("reset").addEventListener("click", () => call("reset"));
$("pace").addEventListener("change", () => call("set_real_time_factor", {factor: Number($("pace").value)}));
$("reset-alarms").addEventListener("click", () => call("reset_alarms"));
$("run").addEventListener("submit", event => event.preventDefault());
