/*
 * The gates, one row each. This list defines enum score_gate_id, the order of measuring, the default bars, the keys of
 * relume-diff.yaml, the columns of the table, and the contents of JSON, JUnit XML and the page.
 *
 * A new gate needs a row, its measure function (in its own file if large), and its name in score.schema.json, which
 * tests compare with the output of `relume diff --json`.
 */
#pragma once

/*
 * ROW(id, name, title, measure, needs_reference, figures...)
 *   id               GATE_id
 *   name, title      for people and files
 *   measure          int measure(struct gate_frame *): 0 or ERR_SYSTEM (reported)
 *   needs_reference  1: not measured if frames are compared with approved ones only
 *   figures          struct score_figure: { name, unit, at_least, bar, share, column }
 */
#define SCORE_GATES(ROW) \
	ROW(V, "V", "validity", gate_validity, 0, { "numbers that are NaN or infinite", "", 0, 0, 0, NULL }) \
	ROW(R1, "R1", "interior colour", gate_interior, 1, { "interior pixels over 2/255", "%", 0, 0.1, 0, "R1 %" }) \
	ROW(R1B, "R1b", "blended pixels", gate_blended, 1, \
	    { "blended pixels over 2/255 + 0.5/255 per layer", "%", 0, 0.1, 0, "R1b %" }) \
	ROW(R2, "R2", "edge band", gate_band, 1, { "band pixels within 2/255 of a neighbour", "%", 1, 99, 0, "R2 %" }) \
	ROW(R3, "R3", "gross errors", gate_gross, 1, { "pixels over 32/255", "px", 0, 4, 1e-5, "R3 px" }) \
	ROW(R4, "R4", "silhouette", gate_silhouette, 1, { "IoU of coverage", "", 1, 0.999, 0, "R4 IoU" }, \
	    { "largest unmatched blob", "px", 0, 4, 0, NULL }) \
	ROW(R5, "R5", "depth", gate_depth, 1, { "interior pixels off in depth", "px", 0, 0, 0, "R5 px" }) \
	ROW(E1, "E1", "closure", gate_closure, 0, { "pixels where the channels do not add up", "px", 0, 0, 0, "E1 px" }) \
	ROW(E2, "E2", "unexplained", gate_unexplained, 0, { "pixels that differ without a reason", "px", 0, 0, 0, "E2 px" }) \
	ROW(E3, "E3", "effects", gate_ranges, 0, { "effects outside of their range", "", 0, 0, 0, "E3" }) \
	ROW(N, "N", "no harm", gate_harm, 0, { "pixels dark without a shadow's edge", "%", 0, 2, 0, "N %" }, \
	    { "pixels dark by known faults", "%", 0, 0.3, 0, NULL }, { "pixels that light burns out", "%", 0, 1, 0, NULL }) \
	ROW(P, "P", "perceptual", gate_perceptual, 1, { "FLIP mean", "", 0, 0.005, 0, "P FLIP" }) \
	ROW(B, "B", "baseline", gate_baseline, 0, { "pixels off from the approved frame", "%", 0, 0.01, 0, "B %" }, \
	    { "HDR-FLIP mean", "", 0, 0.01, 0, "B FLIP" })

/* ROW(id, name): effects distinguished by E3 and the figures; "any" is the last. */
#define SCORE_EFFECTS(ROW) \
	ROW(SHADOW, "shadow") ROW(RELIGHT, "relight") ROW(REFLECT, "reflect") ROW(REFRACT, "refract") ROW(ANY, "any")
