// Points and outlines in pixels, y down: a point is [x, y]; an outline is the data of an SVG path.
"use strict";
const mod = (a, b) => a - b * Math.floor(a / b);
const add = (a, b) => [a[0] + b[0], a[1] + b[1]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1]];
const mul = (a, b) => [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
const by = (a, k) => [a[0] * k, a[1] * k];
const back = (a) => [a[0], -a[1]];
const size = (a) => Math.hypot(a[0], a[1]);
const unit = (a) => { const long = size(a); return long > 0 ? by(a, 1 / long) : [1, 0]; };
const xy = (a) => a[0].toFixed(4) + " " + a[1].toFixed(4);
const line = (points) => "M" + points.map(xy).join("L");
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
const ends = (numbers) => [Math.min(...numbers), Math.max(...numbers)];

// Returns the corners of the convex hull of points (monotone chain, Andrew 1979).
function hull(points) {
  const sorted = points.slice().sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (some) => some.reduce((kept, point) => {
    const turns = ([x, y], [u, v]) => x * v - y * u;
    while (kept.length > 1 && turns(sub(kept.at(-1), kept.at(-2)), sub(point, kept.at(-1))) <= 1e-6) kept.pop();
    if (!kept.length || size(sub(point, kept.at(-1))) > 1e-3) kept.push(point);
    return kept;
  }, []);
  const [lower, upper] = [chain(sorted), chain(sorted.reverse())];
  return lower.length < 2 ? lower : [...lower.slice(0, -1), ...upper.slice(0, -1)];
}

// Returns the outline at a distance around the hull of points; one below 0 runs the other way, as a hole does.
function rounded(points, distance) {
  const corners = hull(points), far = Math.abs(distance), sweep = distance > 0 ? 1 : 0;
  const arc = (to) => `A${far} ${far} 0 0 ${sweep} ${xy(to)}`;
  if (corners.length === 1) {
    const [one, other] = [far, -far].map((x) => add(corners[0], [x, 0]));
    return `M${xy(one)}${arc(other)}${arc(one)}Z`;
  }
  const normal = (n) => by(mul(unit(sub(corners[(n + 1) % corners.length], corners[n])), [0, -1]), far);
  const bends = corners.map((corner, n) => [normal((n || corners.length) - 1), normal(n)].map((way) => add(corner, way)));
  if (!sweep) bends.reverse().forEach((bend) => bend.reverse());
  return `M${bends.map(([one, other]) => xy(one) + arc(other)).join("L")}Z`;
}

// Returns a loop of a path, given by steps, each of whose points has moved with the end that was nearest to it.
function stretched(loop, old, fresh) {
  const numbers = loop.match(/-?(\d+\.?\d*|\.\d+)(e-?\d+)?/g).map(Number), points = [];
  for (let n = 0; n < numbers.length; n += 2) points.push(add(points.at(-1) || [0, 0], numbers.slice(n, n + 2)));
  return line(points.map((point) => {
    const offs = old.map((end) => size(sub(point, end))), near = offs.indexOf(Math.min(...offs));
    return add(point, sub(fresh[near], old[near]));
  })) + "Z";
}

// Returns both ends of a joint's way in the frame of a part, along the part or across it, over many poses.
function endsIn(poses, { at, tail, head }, name) {
  const way = poses.map((of) => {
    const turn = tail === head ? [1, 0] : unit(sub(of.get(head), of.get(tail)));
    return mul(sub(of.get(name), of.get(at)), back(turn));
  });
  const spread = [0, 1].map((n) => { const [low, high] = ends(way.map((one) => one[n])); return high - low; });
  const n = spread[0] >= spread[1] ? 0 : 1;
  way.sort((one, other) => one[n] - other[n]);
  return [way[0], way.at(-1)];
}

// Gives the paths of a part the outlines that it has in other poses than those that it was drawn for.
function reshape(paths, mover, { before, after }) {
  const [old, fresh] = [before, after].map((poses) => mover.reaches.flatMap((name) => endsIn(poses, mover, name)));
  const reach = Math.max(...fresh.map(size));
  paths.forEach((path, n) => {
    const loops = path.getAttribute("d").split("Z");
    path.setAttribute("d", mover.forms[n].map((form, k) => {
      if (!form) return stretched(loops[k], old, fresh);
      const [distance, numbers, grows] = form;
      return rounded(numbers.map((number) => fresh[number]), distance + (grows || 0) * reach);
    }).join(""));
  });
}
