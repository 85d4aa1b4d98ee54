// Other lengths: sliders for them, and the motion of the linkage as it is solved anew.
"use strict";
const lengthsOf = (model, { view, say, said, short, state, byId, renewed }) => {
  const TURN = 2 * Math.PI, BESIDE = 1e-4;
  const solver = solverOf(model), first = model.values.slice();
  const [scale, left, top] = view;
  let range = null, course = null, base = Object.create(null), on = false;

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

  // Returns all points at a phase in pixels, null where rounding leaves the linkage open.
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
    for (const name in joints && model.masses) {
      const [one, other, share] = model.masses[name], [here, there] = [found[one], found[other]];
      const along = (kind) => add(here[kind], mul(share, sub(there[kind], here[kind])));
      found[name] = one === other ? { ...here, p: add(here.p, share) } : { p: along("p"), v: along("v"), a: along("a") };
    }
    Object.assign(kept, { phase, found: joints && found });
    return kept.found;
  }
  const track = (name) => ({
    at(phase) {
      // at a limit a rounded root may be just below zero
      for (const off of [0, 1e-7, -1e-7, 1e-5, -1e-5]) {
        const found = posed(phase + off);
        if (!found) continue;
        // at a limit the input stands while rates by its angle are unbounded: their product is read beside it
        const beside = range && Math.abs(Math.sin(phase)) < BESIDE && posed(phase + (Math.tan(phase) < 0 ? -BESIDE : BESIDE));
        return beside ? { ...beside[name], p: found[name].p } : found[name];
      }
      return { p: pixel([0, 0]), v: [0, 0], a: [0, 0] };
    },
  });
  const tracks = new Map([...model.joints.map(({ name }) => name), ...Object.keys(model.masses)].map((name) => [name, track(name)]));

  const degrees = (angle) => `${(angle * 180 / Math.PI).toFixed(1).replace("-", "−")}°`;
  function told() {
    const found = solver.grashof(), relation = found && [">", "=", "<"][found.sign + 1];
    const moves = range ? said("The input swings between {low} and {high}.", { low: degrees(range.low), high: degrees(range.high) }) : said("The input turns fully.");
    if (!found) return moves;
    const sums = `s + l = ${short(found.sums[0])} ${relation} p + q = ${short(found.sums[1])}`;
    return said("{class_name}: {sums}. {moves}", { class_name: found.name, sums, moves });
  }

  function inputWords(phase) {
    const [angle] = inputAt(phase);
    return degrees(range ? angle : mod(angle, TURN));
  }

  // Returns the input's speed in words: as given where it turns, else how often it goes there and back.
  function speedWords(speed, words) {
    const each = Math.abs(speed) * 30 / Math.PI;
    if (range) return said("{count} swings/min", { count: short(each) });
    return words.endsWith("rpm") ? words : `${short(speed * 30 / Math.PI)} rpm`;
  }

  function renew() {
    // the first dyad on its other closure, on request
    base = Object.create(null);
    const turned = model.joints.find(({ kind }) => kind === "bars" || kind === "slider");
    if (state.side && turned) base[turned.name] = -1;
    const found = solver.range(base);
    if (found === undefined) {
      byId("made").textContent = said("With these lengths the linkage closes at no angle of the input.");
      return false;
    }
    range = found;
    course = range && solver.course(range, base);
    kept.phase = NaN;
    tracks.period = TURN * (course ? course.periods : model.turns);
    byId("made").textContent = told();
    return true;
  }

  const entries = model.sliders.map(({ label, at, number, least, most }) => {
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
    return { box, at, reset() { slider.value = first[number]; tell(); } };
  });
  function change(number, value) {
    solver.set(number, value);
    if (!renew()) return;
    on = true;
    renewed();
  }
  byId("sliders").replaceChildren(...entries.map(({ box }) => box));
  byId("reset").addEventListener("click", () => {
    first.forEach((value, number) => solver.set(number, value));
    for (const entry of entries) entry.reset();
    renew();
    on = false;
    renewed();
  });
  renew();

  return {
    solver, change, rows: entries.map(({ box, at }) => [box, at]), get on() { return on; }, get range() { return range; },
    tracks, told, renew, inputAt, inputWords, speedWords,
  };
};
