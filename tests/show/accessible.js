/*
 * Run in the report's page, after its own script: checks accessibility for low vision, screen readers and keyboard
 * use, and prints faults on the console. The list is hand-written, after WCAG 2.2; each entry names its criterion.
 */
const wrong = [];
const check = (good, what) => { if (!good) wrong.push(what); };
const all = selector => [...document.querySelectorAll(selector)];
const key = (k, at = document) => at.dispatchEvent(new KeyboardEvent("keydown", { key: k, bubbles: true, cancelable: true }));

/* A control's accessible name, as far as this page needs it. */
function name_of(node)
{
	const of_label = node.closest("label");
	return (node.getAttribute("aria-label") || node.getAttribute("alt") || (of_label && of_label.textContent) || node.textContent || "").trim();
}

/* Relative luminance and contrast, as WCAG defines them. */
function luminance(color)
{
	const [r, g, b] = color.match(/[\d.]+/g).map(v => v / 255).map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
	return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
function background_of(node)
{
	for (; node; node = node.parentElement) {
		const color = getComputedStyle(node).backgroundColor;
		if (!/, 0\)$/.test(color))
			return color;
	}
	return "rgb(255, 255, 255)";
}
function contrast_of(node)
{
	const [a, b] = [getComputedStyle(node).color, background_of(node)].map(luminance).sort((x, y) => y - x);
	return (a + 0.05) / (b + 0.05);
}

function look(view)
{
	for (const image of all("#frame img"))
		check(image.alt.length > 3, `1.1.1 ${view}: a picture without words: ${image.dataset.name}`);
	check(all("svg[role=img]").every(svg => svg.getAttribute("aria-label")), "1.1.1 the chart has no words");
	for (const table of all("table"))
		check(table.caption && [...table.rows[0].cells].every(cell => cell.tagName === "TH" && cell.scope === "col" && cell.textContent),
			`1.3.1 ${view}: a table without caption or headings`);
	const levels = all("h1, h2, h3").map(node => +node.tagName[1]);
	check(levels[0] === 1 && levels.filter(level => level === 1).length === 1 && levels.every((level, i) => !i || level <= levels[i - 1] + 1),
		`1.3.1 headings: ${levels}`);
	for (const node of all("button, input, select, [role=region], [role=group], [role=listbox], nav, section"))
		check(name_of(node), `4.1.2 ${view}: no name: ${node.outerHTML.slice(0, 80)}`);
	for (const node of all(".dim, .passed, .failed, .new, .missing, figcaption, td, th, li span, button:not(:disabled), code"))
		if (node.textContent.trim() && node.offsetParent)
			check(contrast_of(node) >= 4.5, `1.4.3 ${view}: contrast ${contrast_of(node).toFixed(1)} of ${node.className || node.tagName}: ${node.textContent.slice(0, 30)}`);
	for (const node of all(".scroll, #list"))
		check(node.tabIndex === 0, `2.1.1 ${view}: the keyboard does not scroll ${node.id || node.className}`);
}

async function operate()
{
	const list = $("list"), now = () => state.frame.frame;
	check(document.documentElement.lang === "en", "3.1.1 no language");
	check(document.title.includes(":") && document.title.includes("passed"), `2.4.2 title: ${document.title}`);
	check(all("header").length && all("main").length && all("nav").length, "1.3.1 landmarks");
	check(document.querySelector("a[href='#frame']"), "2.4.1 no way around the list");
	for (const mode of ["1", "2", "3", "4"]) {
		key(mode);
		look("view " + mode);
	}
	check(all("#list > *").every(item => item.getAttribute("role") === "option" && item.hasAttribute("aria-selected") && item.hasAttribute("aria-checked")),
		"4.1.2 options without state");
	/* Keyboard only: to a frame, select it, to the last one; menus keep their own keys. */
	list.focus();
	check(document.activeElement === list, "2.1.1 the list takes no focus");
	key("Home", list);
	const first = now();
	check(list.getAttribute("aria-activedescendant") === "o" + first && $("o" + first), "4.1.2 which option is active");
	key("ArrowDown", list);
	check(now() !== first && $("announced").textContent.startsWith(label(state.frame)), `4.1.3 no message of the frame shown: ${$("announced").textContent}`);
	key(" ", list);
	check($("o" + now()).getAttribute("aria-checked") === "true" && !$("copy").disabled, "2.1.1 space selects no frame");
	key("End", list);
	check(now() === list.lastChild.frame.frame, "2.1.1 End");
	const before = now();
	for (const node of all("select, input"))
		key("ArrowUp", node), key("k", node);
	check(now() === before, "2.1.4 keys of a menu go to the list");
	check($("announced").getAttribute("role") === "status" && $("chosen").getAttribute("aria-live"), "4.1.3 live regions");
}

const tell = () => { console.log("FOUND" + JSON.stringify({ wrong }) + "DNUOF"); };
addEventListener("load", () => setTimeout(() => operate().catch(error => wrong.push(error.stack)).then(tell), 100));
