/* Run in the report's page, after its own script: operates it like a person, and prints the results on the console. */
const found = { errors: window.wrong };

async function operate()
{
	const list = $("list");
	const wait = ms => new Promise(done => setTimeout(done, ms));
	const key = (k, at = document, more = {}) => at.dispatchEvent(new KeyboardEvent("keydown", { key: k, bubbles: true, cancelable: true, ...more }));
	const images = () => [...document.querySelectorAll("#views img")];
	const names = () => images().map(image => image.dataset.name);
	const captions_shown = () => [...document.querySelectorAll("#views figcaption")].map(node => node.textContent);
	const now = () => state.frame.frame;
	const control = label => document.querySelector(`[aria-label='${label}']`);
	const change = (node, value) => { node.value = value; node.dispatchEvent(new Event("change", { bubbles: true })); };
	const type = text => { $("filter").value = text; $("filter").dispatchEvent(new Event("input", { bubbles: true })); return list.children.length; };
	const zoomed = async () => { await wait(60); return images()[0].width / images()[0].naturalWidth; };
	const move = (node, x, y) => {
		const box = node.getBoundingClientRect();
		node.dispatchEvent(new MouseEvent("mousemove", { clientX: box.left + x, clientY: box.top + y, bubbles: true }));
	};
	await wait(200);

	/* Contents after loading. */
	found.opened = now();
	found.shown_at_first = [list.children.length, control("outcome").value];
	found.title = document.title;
	found.verdicts = [...document.querySelectorAll("#verdicts li")].map(node => node.className + ": " + node.textContent);
	change(control("outcome"), "");
	found.frames = list.children.length;
	found.order = [...list.children].slice(0, 3).map(item => item.frame.frame);
	found.about = $("about").textContent.replace(/^.* against /, "").replace(/, .*/, "");
	found.zooms = [...document.querySelectorAll("#tools select")].pop().textContent;
	found.verdict = $("verdict").textContent + ", " + $("verdict").className;
	found.counts = $("counts").textContent;
	found.bars = document.querySelectorAll("#chart rect").length - 1;
	const bar = document.querySelectorAll("#chart rect")[1].getBBox();
	found.bar = [bar.x, Math.round(bar.y + bar.height), Math.round(bar.height), (bar.width * found.bars / 1000).toFixed(2)];
	found.chart = document.querySelector("#chart + div").textContent.replace(/^.*; /, "");
	found.heading = document.querySelector("#frame h2").textContent;
	const selected = document.querySelector("[aria-selected=true]").getBoundingClientRect(), room = list.getBoundingClientRect();
	found.in_sight = selected.top >= room.top - 1 && selected.bottom <= room.bottom + 1;
	found.row = [...list.children[0].children].slice(2).map(node => node.textContent).join("|");
	found.gates = document.querySelectorAll("#frame table")[0].rows.length;
	found.gate = [...document.querySelectorAll("#frame tr")].map(row => [...row.cells].map(cell => cell.textContent)).find(row => row[0] === "R1").slice(2, 5).join("|");
	found.approve = [...document.querySelectorAll("#frame code")].pop().textContent.replace(/ \S*$/, "").replace(/ \/\S*/g, "");
	found.outcomes = [...control("outcome").options].map(option => option.value);

	/* Moving from frame to frame. */
	list.children[0].click(); found.clicked = [now(), location.hash, [...list.children].filter(item => item.getAttribute("aria-selected") === "true").length];
	await wait(200); found.thumbnails = [list.children[0], list.lastChild].map(item => item.querySelector("img").src.slice(0, 11));
	key("k"); found.before_first = now();
	key("j"); found.next = now();
	key("ArrowDown"); found.after = now();
	key("ArrowUp"); key("k"); found.back = now();
	document.querySelectorAll("#chart rect")[2].onclick(); found.bar_clicked = now();
	list.lastChild.click(); key("j"); found.after_last = now() === list.lastChild.frame.frame;
	key("k", $("filter")); key("k", document, { ctrlKey: true }); found.typed = now() === list.lastChild.frame.frame;

	/* Filters. */
	key("/"); found.focus = document.activeElement.id;
	$("filter").blur();
	found.by_number = [type(String(list.lastChild.frame.frame)), list.children[0].frame.frame];
	const gate = failed_gates(frames[0])[0];
	found.by_gate = [type(` ${gate.toLowerCase()} `), type(gate), type("r")];
	key("j"); key("j"); type(gate); list.children[0].click(); key("j"); found.among_filtered = now();
	found.by_draw = type("draw 1");
	found.nothing = type("no such thing");
	found.all_again = type("");
	change(control("outcome"), "passed"); found.passed = [list.children.length, list.children[0].lastChild.textContent];
	change(control("outcome"), "failed"); found.failed = list.children.length;
	found.both = type("1");
	change(control("outcome"), ""); type("");

	/* Selecting frames to approve: by box, by key, all those shown; repeating deselects them. */
	const chosen = () => $("chosen").textContent.replace(/ \S* \S*$/, "");
	const marked = () => [...list.children].filter(item => item.getAttribute("aria-checked") === "true").length;
	found.nothing_chosen = [chosen(), $("copy").disabled];
	list.children[0].click();
	list.children[1].querySelector(".box").click(); found.chosen = [chosen(), now() === list.children[0].frame.frame, $("copy").disabled];
	key("x"); found.chosen_by_key = [chosen(), marked()];
	key("x"); $("choose").click(); found.chosen_all = [marked() === list.children.length, chosen().replace(/.* /, "")];
	change(control("outcome"), "passed"); $("choose").click(); change(control("outcome"), "");
	found.dropped = marked();
	$("choose").click(); $("choose").click(); found.chosen_none = chosen();

	/* Views. */
	list.children[0].click();
	key("4"); found.all = names();
	key("1"); found.side = names();
	found.pressed = [...document.querySelectorAll("button[aria-pressed=true]")].map(button => button.textContent);
	key("2"); found.blink = [captions_shown()[0], names()[0]];
	await wait(600); found.blinked = [captions_shown()[0], names()[0]];
	await wait(500); found.blinked_back = names()[0];
	key("3"); await wait(100); found.swipe = [names(), captions_shown()[0], images()[1].style.clipPath];
	const layers = document.querySelector(".swipe"), width = layers.getBoundingClientRect().width;
	found.wide = [width / images()[0].width, getComputedStyle(images()[1]).position];
	found.line = [document.querySelector(".swipe .line").style.left, document.querySelector(".swipe .line").getBoundingClientRect().height > 0];
	move(layers, width / 4, 2); found.line_moved = document.querySelector(".swipe .line").style.left; found.swiped = [images()[1].style.clipPath, +document.querySelector("figure > input").value];
	const slider = document.querySelector("figure > input");
	slider.value = 80; slider.dispatchEvent(new Event("input")); found.slid = images()[1].style.clipPath;
	change(control("picture b"), found.all[found.all.length - 1]); found.other = [names(), control("picture b").value];
	change(control("picture a"), found.all[1]); found.other_a = names();
	document.querySelector("#tools button").click(); found.button = names().length;
	await wait(700); found.timer_ended = names().length;
	key("5"); found.roles = names();

	/* Zoom, and the pixel under the pointer. */
	key("1");
	found.zoom = [await zoomed()];
	for (const k of "+++++-----+")
		key(k), found.zoom.push(await zoomed());
	found.scaling = $("views").style.getPropertyValue("--scaling");
	key("-"), found.scaling_small = $("views").style.getPropertyValue("--scaling");
	change([...document.querySelectorAll("#tools select")].pop(), 4); found.chosen = [await zoomed(), state.zoom];
	move(images()[0], 4 * 3 + 1, 4 * 2 + 1); await wait(100);
	move(images()[0], 4 * 3 + 1, 4 * 2 + 1); found.pixel = $("pixel").textContent;
	move(images()[0], 1, 1); found.corner = $("pixel").textContent;
	move(images()[0], -1, 1); found.outside = $("pixel").textContent;
}

const tell = () => { console.log("FOUND" + JSON.stringify(found) + "DNUOF"); };
addEventListener("load", () => setTimeout(() => operate().catch(error => found.errors.push(error.stack)).then(tell), 100));
