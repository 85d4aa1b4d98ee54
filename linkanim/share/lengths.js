// Other lengths: sliders for them, and the linkage drawn plainly as it is solved anew.
"use strict";
const lengthsOf = (model, { kinds, part, put, say, unit, add, by, xy, line, view, short, state, byId, wake }) => {
  const TURN = 2 * Math.PI, FRAME = 360;
  const solver = solverOf(model), first = model.values.slice();
  const [scale, left, top] = view;
  const root = byId("own"), picture = byId("picture"), whole = picture.getAttribute("viewBox");
  let range = null, course = null, base = Object.create(null), moves = [], tracks = new Map(), on = false;

  const pixel = ([x, y]) => [left + scale * x, top - scale * y];
  const turned = ([x, y]) => [scale * x, -scale * y];

  // Returns the phase of the same pose on the way that a swing comes back along, and 1 or, on the way back, -1.
  function unfolded(phase) {
    if (!course || course.free) return [phase, 1];
    const { first, last } = course, long = last - first, along = (((phase - first) % (2 * long)) + 2 * long) % (2 * long);
    return along <= long ? [first + along, 1] : [first + 2 * long - along, -1];
  }

  // Returns the input's angle at a phase, and its first two derivatives: there and back where it swings.
  function inputAt(phase) {
    if (!range) return [model.start + phase, 1, 0];
    const middle = (range.low + range.high) / 2, reach = (range.high - range.low) / 2, [there, way] = unfolded(phase);
    return [middle - reach * Math.cos(there), way * reach * Math.sin(there), reach * Math.cos(there)];
  }

  // Returns all joints at a phase in pixels, null where rounding leaves them open.
  const kept = { phase: NaN, found: null };
  function posed(phase) {
    if (kept.phase === phase) return kept.found;
    const [angle, rate, second] = inputAt(phase), joints = solver.solve(angle, course ? course.flips(unfolded(phase)[0]) : base), found = Object.create(null);
    for (const name in joints || {}) {
      const { p, v, a } = joints[name];
      found[name] = {
        p: pixel(p), v: turned(by(v, rate)), a: turned(add(by(a, rate * rate), by(v, second))),
      };
    }
    Object.assign(kept, { phase, found: joints && found });
    return kept.found;
  }
  const track = (name) => ({
    at(phase) {
      // at a limit a rounded root may be just below zero
      for (const off of [0, 1e-7, -1e-7, 1e-5, -1e-5]) {
        const found = posed(phase + off);
        if (found) return found[name];
      }
      return { p: pixel([0, 0]), v: [0, 0], a: [0, 0] };
    },
  });

  function links(group) {
    const width = 0.016 * Number(whole.split(" ")[2]);
    const rims = { stroke: "var(--ink)", "stroke-width": 1.2, "stroke-linejoin": "round", "stroke-linecap": "round" };
    const drawn = model.links.map(({ joints, slider, colour }) => {
      if (slider) {
        const { way } = model.joints.find(({ name }) => name === slider), turn = unit([way[0], -way[1]]);
        const node = part(group, "rect", { x: -1.5 * width, y: -width, width: 3 * width, height: 2 * width, fill: colour, ...rims });
        return (place) => put(node, "transform", `matrix(${turn[0]} ${turn[1]} ${-turn[1]} ${turn[0]} ${xy(place(slider))})`);
      }
      const bar = { fill: joints.length > 2 ? colour : "none", stroke: colour, "stroke-width": width, "stroke-linejoin": "round", "stroke-linecap": "round" };
      const back = part(group, "path", { ...bar, fill: joints.length > 2 ? "var(--ink)" : "none", stroke: "var(--ink)", "stroke-width": width + 3 });
      const node = part(group, "path", bar);
      return (place) => {
        const path = line(joints.map(place)) + (joints.length > 2 ? "Z" : "");
        for (const each of [back, node]) put(each, "d", path);
      };
    });
    const pins = model.joints.map(({ name, kind }) => {
      const rock = kind === "pin" && part(group, "path", { d: `M0 0L${-width} ${1.7 * width}H${width}Z`, fill: "none", stroke: "var(--ink)", "stroke-width": 1.5 });
      const node = part(group, "circle", { r: 0.36 * width, fill: "var(--back)", stroke: "var(--ink)", "stroke-width": 1.5 });
      return (place) => { for (const each of [rock, node]) if (each) put(each, "transform", `translate(${xy(place(name))})`); };
    });
    return [...drawn, ...pins];
  }

  // Keeps all of a period in the picture.
  function fit() {
    const [x, y, wide, high] = whole.split(" ").map(Number), margin = 0.05 * wide;
    const box = [x, y, x + wide, y + high];
    for (let n = 0; n < FRAME; n += 4) for (const name of tracks.keys()) {
      const { p } = tracks.get(name).at(tracks.period * n / FRAME);
      box[0] = Math.min(box[0], p[0] - margin); box[1] = Math.min(box[1], p[1] - margin);
      box[2] = Math.max(box[2], p[0] + margin); box[3] = Math.max(box[3], p[1] + margin);
    }
    put(picture, "viewBox", `${box[0]} ${box[1]} ${box[2] - box[0]} ${box[3] - box[1]}`);
  }

  const degrees = (angle) => `${(angle * 180 / Math.PI).toFixed(1).replace("-", "−")}°`;
  function told() {
    const found = solver.grashof(), relation = found && [">", "=", "<"][found.sign + 1];
    const sums = found ? `${found.name}: s + l = ${short(found.sums[0])} ${relation} p + q = ${short(found.sums[1])}. ` : "";
    return `${sums}${range ? `The input swings between ${degrees(range.low)} and ${degrees(range.high)}.` : "The input turns fully."}`;
  }

  function inputWords(phase) {
    const [angle] = inputAt(phase);
    return degrees(range ? angle : angle - TURN * Math.floor(angle / TURN));
  }

  function renew() {
    // the first dyad on its other closure, on request
    base = Object.create(null);
    const turned = model.joints.find(({ kind }) => kind === "bars" || kind === "slider");
    if (state.side && turned) base[turned.name] = -1;
    const found = solver.range(base);
    if (found === undefined) {
      byId("made").textContent = "With these lengths the linkage closes at no angle of the input.";
      return false;
    }
    range = found;
    course = range && solver.course(range, base);
    kept.phase = NaN;
    tracks = new Map(model.joints.map(({ name }) => [name, track(name)]));
    tracks.period = TURN * (course ? course.periods : model.turns);
    byId("made").textContent = told();
    root.replaceChildren();
    moves = links(root);
    for (const mover of model.movers) moves.push(kinds[mover.kind](part(root, "g", {}), mover, tracks));
    if (on) fit();
    return true;
  }

  function show(yes) {
    on = yes;
    root.toggleAttribute("hidden", !on);
    if (on) fit(); else put(picture, "viewBox", whole);
    wake();
  }

  const entries = model.sliders.map(({ label, number, least, most }) => {
    const box = document.createElement("label"), name = document.createElement("span");
    const slider = document.createElement("input"), value = document.createElement("output");
    name.textContent = label;
    Object.assign(slider, { type: "range", step: "any", min: least, max: most, value: first[number] });
    slider.setAttribute("aria-label", label);
    const tell = () => {
      const text = `${short(solver.values[number])} ${model.unit}`;
      say(value, text);
      slider.setAttribute("aria-valuetext", text);
    };
    slider.addEventListener("input", () => { change(number, Number(slider.value)); tell(); });
    box.append(name, slider, value);
    tell();
    return { box, reset() { slider.value = first[number]; tell(); } };
  });
  function change(number, value) {
    solver.set(number, value);
    if (renew()) show(true);
  }
  byId("sliders").replaceChildren(...entries.map(({ box }) => box));
  byId("reset").addEventListener("click", () => {
    first.forEach((value, number) => solver.set(number, value));
    for (const entry of entries) entry.reset();
    renew();
    show(false);
  });
  renew();

  return {
    solver, change, get on() { return on; }, get range() { return range; }, get moves() { return moves; },
    get tracks() { return tracks; }, renew, inputWords,
  };
};
