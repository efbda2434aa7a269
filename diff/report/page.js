/* The page's script: page.html has its place. `run` is what `relume diff --json` says. */
"use strict";
const $ = id => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
	const node = Object.assign(document.createElement(tag), properties);
	node.append(...children);
	return node;
};
const per_cent = x => (100 * x).toFixed(x === 1 ? 0 : 3) + " %";
const number = x => x === null ? "-" : Number(x.toPrecision(6)).toString();
/* "frame 12", or the name of a picture that has no number. */
const label = f => f.name || "frame " + f.frame;
/* A table with a heading for people and one for each column; in a region that the keyboard can scroll. */
function table_of(caption, columns, rows) {
	const table = make("table", {}, make("caption", { textContent: caption }), make("tr", {}, ...columns.map(t => make("th", { textContent: t, scope: "col" }))), ...rows);
	const region = make("div", { className: "scroll " + caption.replaceAll(" ", "-"), tabIndex: 0 }, table);
	region.setAttribute("role", "region");
	region.setAttribute("aria-label", caption);
	return region;
}
/* Pictures stand in blocks of their own, which cost nothing until they are read. */
const read = f => { const block = $("p" + f.frame); return block ? JSON.parse(block.textContent) : null; };
const have_pictures = f => f === state.frame ? state.pictures : null;
const failed_gates = f => Object.entries(f.gates).filter(([, g]) => g.state === "failed").map(([name]) => name);
/* Per cent of pixels that have changed since the frame was approved. */
const changed = f => run.baseline && f.gates && f.gates.B.figures.length ? f.gates.B.figures[0].value : 0;
/* How much of a frame is as it should be, by what it is compared with: what the chart shows. */
const level = f => Math.min(run.reference ? f.fidelity : 1, 1 - changed(f) / 100);
const compared = f => ["passed", "failed", "flaky", "new"].includes(f.outcome);
const warns = f => Object.values(f.gates || {}).some(g => g.state === "warned");
const frames = [...run.frames].sort((a, b) => (a.outcome === "passed") - (b.outcome === "passed") || a.frame - b.frame);
const captions = { approved: "approved", change: "difference x 8, approved to now", changed: "red has changed since it was approved",
	reference: "raster (reference)", difference: "difference x 8", flip: "FLIP error, dark is none", failing: "red fails, blue is the edge band" };
const SIDE_BY_SIDE = ["reference", "compared", "beauty", "difference", "flip"];
const NOT_PASSED = "not passed";
/* a, b: pictures to blink and swipe; null: those of the comparison that failed. chosen: frames to approve. */
const state = { frame: null, pictures: null, mode: "side", a: null, b: null, zoom: 1, shown: frames, timer: 0, chosen: new Set() };

/* Which gates ask which question. */
const of_reference = name => name.startsWith("R") || name === "P";
const of_baseline = name => name === "B";
const of_itself = name => !of_reference(name) && !of_baseline(name);
const failed_of = (f, which) => failed_gates(f).filter(which);

function show_header() {
	const all_passed = run.frames.every(f => f.outcome === "passed" || f.outcome === "flaky");
	$("name").textContent = run.name;
	document.title = `${run.name}: ${all_passed ? "passed" : "not passed"} - relume diff`;
	$("verdict").textContent = all_passed ? "passed" : "not passed";
	$("verdict").className = all_passed ? "passed" : "failed";
	for (const [name, count] of Object.entries(run.counts))
		if (count)
			$("counts").append(make("b", { className: name, textContent: count + " " + name }));
	const against = [run.reference, run.baseline && "approved frames in " + run.baseline].filter(x => x).join(" and ");
	$("about").textContent = `${run.traced} against ${against}; ${run.frames.length} frames, ${run.seconds.toFixed(1)} s. ` +
		("first_wrong_frame" in run ? `The first that is wrong: ${label(run.frames.find(f => f.frame === run.first_wrong_frame))}. ` : "") +
		"All pictures of what did not pass are in this page (as long as they take no more than 64 MB), and of what passed up to 16 MB.";
	$("command").textContent = run.command;
	if (run.frames.some(f => f.programs))
		$("chart").before(make("details", {}, make("summary", { textContent: "programs, over all frames" }), program_table(sum_programs(run.frames))));
	if ($("film"))
		$("chart").before(make("video", { src: JSON.parse($("film").textContent), controls: true, loop: true, muted: true, playsInline: true }));
}

function show_chart() {
	const shown = run.frames, lowest = Math.min(1, ...shown.filter(compared).map(level));
	const floor = lowest > 0.99 ? 0.99 : lowest > 0.9 ? 0.9 : 0, W = 1000, H = 90, svg = $("chart");
	const width = W / shown.length;
	svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
	svg.setAttribute("preserveAspectRatio", "none");
	const node = (tag, attributes, text) => {
		const n = document.createElementNS("http://www.w3.org/2000/svg", tag);
		for (const [k, v] of Object.entries(attributes))
			n.setAttribute(k, v);
		if (text)
			n.append(Object.assign(document.createElementNS("http://www.w3.org/2000/svg", "title"), { textContent: text }));
		svg.append(n);
		return n;
	};
	node("rect", { x: 0, y: 0, width: W, height: H, fill: "none", stroke: "var(--line)", "vector-effect": "non-scaling-stroke" });
	shown.forEach((f, i) => {
		const part = compared(f) ? Math.max(0.02, (level(f) - floor) / (1 - floor)) : 1;
		const color = f.outcome === "passed" ? "var(--good)" : compared(f) || f.outcome === "missing" ? "var(--bad)" : "var(--odd)";
		const bar = node("rect", { x: i * width, y: H - part * (H - 4), width: width * 0.86, height: part * (H - 4), fill: color,
			"fill-opacity": compared(f) ? 0.75 : 0.25 },
			`${label(f)}: ${f.outcome}` + (compared(f) ? `, ${per_cent(level(f))}` : ""));
		bar.style.cursor = "pointer";
		bar.onclick = () => select(f);
	});
	svg.after(make("div", { className: "dim", textContent: (run.baseline ? "pixels that are as approved" : "") +
		(run.baseline && run.reference ? ", or " : "") + (run.reference ? "fidelity (pixels that pass R1, R1b or R2)" : "") + (run.baseline && run.reference ? ", the lower of both," : "") + " over " +
		`${label(shown[0])} to ${label(shown[shown.length - 1])}; the floor of the chart is ${100 * floor} %, its top 100 %` }));
}

/* A row's thumbnail is read when the row is scrolled into sight. */
const thumbnails = new IntersectionObserver(rows => {
	for (const row of rows) {
		const image = row.target.querySelector("img");
		if (!row.isIntersecting || image.src)
			continue;
		const pictures = read(row.target.frame);
		thumbnails.unobserve(row.target);
		if (pictures && pictures.thumbnail)
			image.src = pictures.thumbnail;
	}
}, { root: $("list") });

function show_list() {
	const text = $("filter").value.trim().toLowerCase(), outcome = $("outcome").value;
	state.shown = frames.filter(f => (!outcome || (outcome === NOT_PASSED ? f.outcome !== "passed" : f.outcome === outcome)) && (!text || (f.name || String(f.frame)).toLowerCase().includes(text) ||
		failed_gates(f).some(g => g.toLowerCase() === text) || f.blame.some(b => "draw " + b.draw === text)));
	$("list").replaceChildren(...state.shown.map(f => {
		const item = make("li", { id: "o" + f.frame, onclick: event => event.target.className === "box" ? choose([f]) : select(f) },
			make("span", { className: "box", title: "select for approval (x)" }), make("img", { alt: "", width: 40, height: 30 }),
			make("span", { textContent: f.name || f.frame, title: label(f) }),
			make("span", { className: f.outcome, textContent: f.outcome + (warns(f) ? " (!)" : "") }),
			make("span", { textContent: !compared(f) ? "" : (failed_gates(f).join(" ") || per_cent(level(f))) + (changed(f) ? ` ${changed(f).toPrecision(3)} %` : "") }));
		item.setAttribute("role", "option");
		item.frame = f;
		thumbnails.observe(item);
		return item;
	}));
	mark_selected();
	show_chosen();
}

function mark_selected() {
	if (state.frame)
		$("list").setAttribute("aria-activedescendant", "o" + state.frame.frame);
	for (const item of $("list").children) {
		item.setAttribute("aria-selected", item.frame === state.frame);
		if (item.frame === state.frame)
			item.scrollIntoView({ block: "nearest" });
	}
}

/* "3-5,9": numbers in order. */
function ranges_of(numbers) {
	const parts = [];
	for (const n of [...numbers].sort((x, y) => x - y)) {
		const last = parts[parts.length - 1];
		if (last && last[1] === n - 1)
			last[1] = n;
		else
			parts.push([n, n]);
	}
	return parts.map(([from, to]) => from === to ? from : from + "-" + to).join();
}

/* For a shell: quoted where it has to be. */
const word = text => /^[\w@%+=:,./-]+$/.test(text) ? text : "'" + text.replaceAll("'", "'\\''") + "'";
const approve_command = numbers => `relume approve -f ${ranges_of(numbers)} ${word(run.traced)} ${run.baseline ? word(run.baseline) : "BASELINE"}`;

/* Select frames for approval, or drop them where all of them are selected. */
function choose(wanted) {
	const can = wanted.filter(f => compared(f) && !f.name), drop = can.every(f => state.chosen.has(f.frame));
	for (const f of can)
		drop ? state.chosen.delete(f.frame) : state.chosen.add(f.frame);
	show_chosen();
}

function show_chosen() {
	for (const item of $("list").children)
		item.setAttribute("aria-checked", state.chosen.has(item.frame.frame));
	$("copy").disabled = !state.chosen.size;
	$("copy").textContent = "copy approve command";
	$("chosen").textContent = state.chosen.size ? approve_command(state.chosen) : "";
}

/* Where a browser gives no clipboard, the command is marked, and the user copies it. */
function copy_command() {
	const copied = () => { $("copy").textContent = "copied"; }, mark = () => getSelection().selectAllChildren($("chosen"));
	if (navigator.clipboard)
		navigator.clipboard.writeText($("chosen").textContent).then(copied, mark);
	else
		mark();
}

/* Pixel values under the pointer, of all pictures of the frame. */
const planes = new Map();
function plane_of(source) {
	if (!planes.has(source)) {
		const image = new Image();
		planes.set(source, null);
		image.onload = () => {
			const canvas = make("canvas", { width: image.naturalWidth, height: image.naturalHeight });
			const context = canvas.getContext("2d", { willReadFrequently: true });
			context.drawImage(image, 0, 0);
			planes.set(source, context);
		};
		image.src = source;
	}
	return planes.get(source);
}
function show_pixel(event) {
	const box = event.target.getBoundingClientRect(), scale = box.width / event.target.naturalWidth;
	const x = Math.floor((event.clientX - box.left) / scale), y = Math.floor((event.clientY - box.top) / scale);
	const parts = [`x ${x}  y ${y}`];
	for (const [name, source] of Object.entries(have_pictures(state.frame) || {})) {
		const context = ["approved", "reference", "compared", "beauty", "shadow", "reflect"].includes(name) && plane_of(source);
		if (context && x >= 0 && y >= 0 && x < context.canvas.width && y < context.canvas.height)
			parts.push(`${title_of(name)} ${[...context.getImageData(x, y, 1, 1).data].slice(0, 3).join(" ")}`);
	}
	$("pixel").textContent = parts.join("   ");
}

function picture(name) {
	const image = make("img", { src: state.pictures[name], alt: `${title_of(name)} of ${label(state.frame)}`, onmousemove: show_pixel });
	image.dataset.name = name;
	image.onload = () => { image.width = image.naturalWidth * state.zoom; image.height = image.naturalHeight * state.zoom; };
	return image;
}
const title_of = name => name === "compared" ? state.frame.layer : name === "beauty" && state.pictures.approved ? "now (beauty)" : captions[name] || name;
const caption = name => make("figcaption", { textContent: title_of(name) });

/* What is compared with the approved frame: the beauty, also where it was compared with the reference. */
const now_of = have => have.beauty ? "beauty" : "compared";

const layers_of = have => Object.keys(have || {}).filter(name => name !== "thumbnail" && !/^(blame|role|finding) /.test(name));
const main_of = (f, have) => !have.approved ? SIDE_BY_SIDE
	: ["approved", now_of(have), "change", ...(failed_of(f, of_reference).length ? ["reference", "compared", "difference", "flip"] : [])];

/* The pictures to blink and swipe. */
function pair() {
	const have = layers_of(state.pictures), usual = state.pictures.approved ? ["approved", now_of(state.pictures)] : ["reference", "compared"];
	return ["a", "b"].map((key, i) => have.includes(state[key]) ? state[key] : have.includes(usual[i]) ? usual[i] : have[0]);
}
const roles_of = have => Object.keys(have || {}).filter(name => name.startsWith("finding ")).map(name => name.slice("finding ".length));

/* The page of roles and lights: what rules made of the frame, why, and how sure that is. */
function show_roles() {
	$("views").append(table_of("roles and lights", ["kind", "role", "confidence", "why", "where: its draws, or what faces the light"], roles_of(state.pictures).map(i => {
		const [kind, role, confidence, why] = state.pictures["finding " + i];
		return make("tr", { className: "role" }, make("td", { textContent: kind }), make("td", { textContent: role }),
			make("td", { className: "number", textContent: confidence }), make("td", { textContent: why }),
			make("td", {}, state.pictures["role " + i] ? picture("role " + i) : ""));
	})));
}


function show_views() {
	const have = have_pictures(state.frame), views = $("views");
	clearInterval(state.timer);
	views.style.setProperty("--scaling", state.zoom < 1 ? "auto" : "pixelated");
	views.classList.toggle("zoomed", state.zoom > 1);
	views.replaceChildren();
	if (!layers_of(have).length) {
		views.append(make("p", { className: "dim", textContent: compared(state.frame)
			? "The pictures of this frame are not in this page; its files are on disk."
			: state.frame.outcome === "missing" ? "There is a reference, but no traced frame."
			: state.frame.outcome === "extra" ? "There is a traced frame, but no reference." : "One of its files cannot be read." }));
		return;
	}
	if (state.mode === "roles" && roles_of(have).length) {
		show_roles();
	} else if (state.mode === "side" || state.mode === "roles") {
		for (const name of main_of(state.frame, have))
			if (have[name])
				views.append(make("figure", {}, caption(name), picture(name)));
	} else if (state.mode === "all") {
		for (const name of layers_of(have))
			views.append(make("figure", {}, caption(name), picture(name)));
	} else if (state.mode === "blink") {
		const [name_a, name_b] = pair(), title = make("figcaption"), a = picture(name_a), b = picture(name_b), place = make("div", {}, a);
		let odd = false;
		const turn = () => {
			place.replaceChildren(odd ? b : a);
			title.textContent = title_of(odd ? name_b : name_a);
			odd = !odd;
		};
		turn();
		if (matchMedia("(prefers-reduced-motion: reduce)").matches)
			views.append(make("button", { textContent: "the other picture", onclick: turn }));
		else
			state.timer = setInterval(turn, 500);
		views.append(make("figure", {}, title, place));
	} else {
		const [name_a, name_b] = pair(), a = picture(name_a), b = picture(name_b), line = make("div", { className: "line" });
		const slider = make("input", { type: "range", min: 0, max: 100, value: 50 });
		const cut = () => { b.style.clipPath = `inset(0 0 0 ${slider.value}%)`; line.style.left = slider.value + "%"; };
		slider.setAttribute("aria-label", "place of the line, per cent");
		slider.oninput = cut;
		cut();
		const layers = make("div", { className: "swipe" }, a, b, line);
		layers.onmousemove = layers.onpointermove = event => {
			const box = layers.getBoundingClientRect();
			slider.value = 100 * (event.clientX - box.left) / box.width;
			cut();
		};
		views.append(make("figure", {}, make("figcaption", { textContent: `left ${title_of(name_a)}, right ${title_of(name_b)}` }),
			layers, slider));
	}
}

function layer_select(key) {
	const have = layers_of(state.pictures), [a, b] = pair();
	const node = make("select", { onchange: () => { state[key] = node.value; show_views(); } },
		...have.map(name => make("option", { value: name, textContent: title_of(name) })));
	node.value = key === "a" ? a : b;
	node.setAttribute("aria-label", "picture " + key);
	return node;
}

function mode_button(mode, text) {
	const node = make("button", { textContent: text, onclick: () => { state.mode = mode; show_frame(); } });
	node.setAttribute("aria-pressed", state.mode === mode);
	return node;
}

function gate_table(f) {
	const rows = [];
	for (const [name, gate] of Object.entries(f.gates)) {
		const figures = gate.figures.length ? gate.figures : [null];
		figures.forEach((figure, i) => rows.push(make("tr", {},
			make("td", { textContent: i ? "" : name }),
			make("td", { textContent: gate.title + (figure ? ": " + figure.name : "") }),
			make("td", { className: "number", textContent: figure ? number(figure.value) + " " + figure.unit : "" }),
			make("td", { className: "number", textContent: figure ? (figure.bound === "at least" ? ">= " : "<= ") + number(figure.bar) + " " + figure.unit : "" }),
			make("td", { className: gate.state === "not measured" ? "dim" : gate.state, textContent: i ? "" : gate.state }),
			make("td", { className: "dim", textContent: i ? "" : gate.note }))));
	}
	return table_of("gates", ["gate", "what", "measured", "bar", "state", "note"], rows);
}

function sum_programs(frames) {
	const sums = new Map();
	for (const p of frames.flatMap(f => f.programs || [])) {
		const sum = sums.get(p.name) || { name: p.name, pixels: 0, failing: 0 };
		sum.pixels += p.pixels;
		sum.failing += p.failing;
		sums.set(p.name, sum);
	}
	return [...sums.values()].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
}

function program_table(programs) {
	return table_of("programs", ["the program's own", "pixels that pass", "of"], programs.map(p =>
		make("tr", {}, make("td", { textContent: p.name }),
			make("td", { className: p.failing ? "number failed" : "number", textContent: per_cent(1 - p.failing / p.pixels) }),
			make("td", { className: "number", textContent: p.pixels.toLocaleString("en") + " px" }))));
}

function blame_table(f) {
	const sides = failed_of(f, of_baseline).length && state.pictures && state.pictures.changed ? "approved, now, changed" : "reference, traced, failing";
	return table_of("draws to blame", ["draw", "call", "uses", "pixels", "share", sides], f.blame.map((b, i) => {
		const source = state.pictures && state.pictures["blame " + i];
		const uses = [b.list && "list " + b.list, b.texture && "texture " + b.texture, b.program && "a program object", b.approved && "in the approved frame",
			b.known && "known: " + b.known];
		return make("tr", {}, make("td", { textContent: b.draw || "background" }),
			make("td", { textContent: b.call ? `${b.call} (call ${b.call_number})` : "" }),
			make("td", { textContent: uses.filter(x => x).join(", ") }),
			make("td", { className: "number", textContent: b.pixels }),
			make("td", { className: "number", textContent: (100 * b.pixels / f.blamed_pixels).toPrecision(3) + " %" }),
			make("td", {}, source ? make("img", { src: source, alt: `draw ${b.draw}: ${sides}` }) : ""));
	}));
}

/* Which comparison failed: a line for each that was made. */
function verdicts(f) {
	const lines = [], note = gate => [...gate.figures.filter(x => x.value !== null).map(x => `${x.name} ${number(x.value)} ${x.unit}`.trim()), gate.note.trim()].filter(x => x).join("; ");
	const is_stored = !state.pictures || !layers_of(state.pictures).length || state.pictures.approved;
	const titles = which => failed_of(f, which).map(g => `${g} ${f.gates[g].title}`).join(", ");
	if (run.baseline)
		lines.push(f.gates.B.state === "failed" ? ["failed", "Not as approved: " + note(f.gates.B) + (is_stored ? "." : ". Only its hashes are stored: there is no picture of it.")]
			: f.outcome === "new" ? ["new", "Nobody has approved this frame."]
			: f.gates.B.state === "not measured" ? ["new", "Not compared with the approved frame: " + f.gates.B.note]
			: ["passed", "As approved."]);
	if (run.reference)
		lines.push(failed_of(f, of_reference).length ? ["failed", `Not as the reference: ${titles(of_reference)}; fidelity ${per_cent(f.fidelity)}`]
			: ["passed", `As the reference, fidelity ${per_cent(f.fidelity)}.`]);
	if (failed_of(f, of_itself).length)
		lines.push(["failed", "By itself: " + titles(of_itself)]);
	return make("ul", { id: "verdicts" }, ...lines.map(([className, textContent]) => make("li", { className, textContent })));
}

function info_text(f) {
	if (!run.reference)
		return "";
	const share = Object.entries(f.info.effect_share).filter(([, v]) => v).map(([k, v]) => `${k} ${per_cent(v)}`).join(", ");
	return `${f.layer}: PSNR ${f.info.gl_psnr_db === null ? "no difference" : number(f.info.gl_psnr_db) + " dB"}, SSIM ${number(f.info.gl_ssim)}, RMSE ${number(f.info.gl_rmse)}, MRSE ${number(f.info.gl_mrse)}. ` +
		`Beauty against the raster frame: FLIP ${number(f.info.beauty_flip)}, MS-SSIM ${number(f.info.beauty_ms_ssim)}, ` +
		`CIEDE2000 p95 ${number(f.info.beauty_ciede_p95)}. ` + (share ? `Pixels touched by effects: ${share}.` : "");
}

function tools(...children) {
	const node = make("div", { id: "tools" }, ...children);
	node.setAttribute("role", "group");
	node.setAttribute("aria-label", "view");
	return node;
}

function show_frame() {
	const f = state.frame, section = $("frame");
	section.replaceChildren(make("h2", {}, label(f) + " ", make("span", { className: f.outcome, textContent: f.outcome }),
		compared(f) && !run.baseline ? ` fidelity ${per_cent(f.fidelity)}` : ""));
	if (compared(f))
		section.append(verdicts(f));
	if (layers_of(state.pictures).length)
		section.append(tools(mode_button("side", "side by side"), mode_button("blink", "blink"),
			mode_button("swipe", "swipe"), mode_button("all", "all channels"),
			...(roles_of(state.pictures).length ? [mode_button("roles", "roles and lights")] : []), layer_select("a"), layer_select("b"),
			make("label", {}, "zoom ", make("select", { onchange: event => { state.zoom = +event.target.value; show_views(); } },
				...[0.5, 1, 2, 4, 8].map(z => make("option", { value: z, textContent: z + " x", selected: z === state.zoom }))))));
	section.append(make("div", { id: "views" }), make("div", { id: "pixel" }));
	if (compared(f)) {
		section.append(gate_table(f), make("p", { className: "dim", textContent: info_text(f) }));
		if (f.flaky_reason)
			section.append(make("p", { className: "flaky", textContent: "known to be flaky: " + f.flaky_reason }));
		if (f.blame.length)
			section.append(blame_table(f));
		if (f.programs)
			section.append(program_table(f.programs));
		if (!f.name)
			section.append(make("p", {}, "To approve this frame: ", make("code", { textContent: approve_command([f.frame]) })));
	}
	show_views();
}

/* Three pictures side by side, where half their size is enough for it. */
function fitting_zoom() {
	const widest = Math.max(...run.frames.map(f => f.width || 0));
	return $("frame").clientWidth < 3 * (widest + 12) ? 0.5 : 1;
}

function select(f) {
	state.frame = f;
	state.pictures = read(f);
	planes.clear();
	location.hash = f.frame;
	$("announced").textContent = `${label(f)}: ${f.outcome}`;
	mark_selected();
	show_frame();
}

function step(by) {
	const at = state.shown.indexOf(state.frame) + by;
	if (at >= 0 && at < state.shown.length)
		select(state.shown[at]);
}

document.addEventListener("keydown", event => {
	if (["INPUT", "SELECT", "VIDEO"].includes(event.target.tagName) || event.ctrlKey || event.altKey || event.metaKey)
		return;
	const modes = { 1: "side", 2: "blink", 3: "swipe", 4: "all", 5: "roles" };
	if (event.key === "j" || event.key === "ArrowDown") { step(1); event.preventDefault(); }
	else if (event.key === "k" || event.key === "ArrowUp") { step(-1); event.preventDefault(); }
	else if (modes[event.key]) { state.mode = modes[event.key]; show_frame(); }
	else if (event.key === "x") choose([state.frame]);
	else if (event.key === " " && event.target === $("list")) { choose([state.frame]); event.preventDefault(); }
	else if (event.target === $("list") && (event.key === "Home" || event.key === "End")) { select(state.shown.at(event.key === "Home" ? 0 : -1)); event.preventDefault(); }
	else if (event.key === "/") { $("filter").focus(); event.preventDefault(); }
	else if (event.key === "+") { state.zoom = Math.min(8, state.zoom * 2); show_frame(); }
	else if (event.key === "-") { state.zoom = Math.max(0.5, state.zoom / 2); show_frame(); }
});
$("outcome").append(make("option", { value: "", textContent: "all" }), make("option", { value: NOT_PASSED, textContent: NOT_PASSED }),
	...Object.keys(run.counts).filter(o => run.counts[o]).map(o => make("option", { value: o, textContent: o })));
$("filter").oninput = $("outcome").onchange = show_list;
$("choose").onclick = () => choose(state.shown);
$("copy").onclick = copy_command;
const first = frames.find(f => String(f.frame) === location.hash.slice(1)) || frames[0];
$("outcome").value = first.outcome === "passed" ? "" : NOT_PASSED; /* only what changed is shown at first */
show_header();
show_chart();
show_list();
state.zoom = fitting_zoom();
select(first);
document.documentElement.dataset.ready = performance.now().toFixed(0); /* ms from the first byte to a page that can be used */
