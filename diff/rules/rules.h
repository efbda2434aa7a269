/*
 * How 'relume diff' compares frames, by recording and by frame: relume-diff.yaml in the current folder, or --config
 * FILE. A missing key keeps its default. An unknown key is an error, reported with its line. The report's page lists
 * the gates.
 *
 * KEYS
 *     baseline: approved          # the folder of 'relume approve', relative to this file
 *     presets:                    # named settings, for use in rules
 *       - name: loose             # the preset's name
 *         inherits: strict        # a preset that is defined before it
 *         codes: 3                # gates R1 and R2: the largest difference that passes, of 255
 *         bars:                   # a gate's figure (1 is the first): it fails beyond fail, and warns beyond warn. It
 *                                 # also fails on the good side of better: an unexpected improvement
 *           - { gate: P, figure: 1, fail: 0.01, warn: 0.005, better: 0.0001 }
 *         ignore: [{ x: 0, y: 0, width: 80, height: 20 }] # rectangles of pixels to ignore
 *     rules:                      # a list; all that match apply, later bars win
 *       - match: "gears*"         # the recording's name, with * and ?; default: every recording
 *         frames: 10-60           # default: every frame
 *         preset: loose           # applied before the rule's own keys, which are those of presets and
 *         channel: gl             # the layer to compare
 *         channels: [shadow.R, id] # required channels (gate V)
 *         ignore_alpha: yes       # as --ignore-alpha
 *         mask: mask.png          # a picture: its white pixels are ignored
 *         effects: [{ effect: shadow, low: 1, high: 40 }] # gate E3: per cent of the pixels that the effect touches
 *     flaky:                      # failures known to be noise. 'relume diff REF RUN RUN...' proposes entries, and
 *                                 # lists those that no run needed
 *       - match: "gears*"         # the recording's name
 *         frames: "17"            # which frames
 *         gates: [R2]             # the gates that may fail
 *         reason: "a driver's lines" # why
 *         expires: 2027-01-31     # the entry's last day
 *
 * All rules that match apply, in the order of the file. A preset applies before the rule that names it, and after the
 * preset that it inherits. Later bars win; rectangles and channels add up.
 *
 * EXAMPLES
 *     # relume-diff.yaml: ignore a clock in a corner, and let 1 % of pixels be off by more than 2 of 255
 *     rules:
 *       - match: "game*"
 *         bars: [{ gate: R1, fail: 1 }]
 *         ignore: [{ x: 0, y: 0, width: 80, height: 20 }]
 *
 *     relume diff --config relume-diff.yaml game.trace out/game.####.exr
 */
#pragma once

#include "diff/score/score.h"

struct score_rules; /* opaque */

enum { SCORE_RULES_MAX_BARS = 64, SCORE_RULES_MAX_CHANNELS = 64 };

/* Settings of one frame; points into the file's settings. */
struct score_rules_frame {
	struct score_options options;
	struct score_bar bars[SCORE_RULES_MAX_BARS];
	const char *channels[SCORE_RULES_MAX_CHANNELS];
	uint8_t *ignore;            /* [height][width], owned; NULL: nothing is ignored */
	unsigned flaky_gates;       /* bit g: gate g is known to be flaky here */
	const char *flaky_reason;   /* reason of the last matching entry; NULL: none */
};

/**
 * Read a file. Errors: unknown keys, wrong types, unknown presets, bad ranges and dates, unreadable masks.
 * @return 0, ERR_INPUT (reported, with the line if known) or ERR_SYSTEM (reported)
 */
int score_rules_read(const char *path, struct score_rules **out);
void score_rules_free(struct score_rules **settings);

/* An allowance for a frame: a bar in place of the default one, or gates that may fail. */
struct score_rules_entry {
	const void *key;         /* identifies the entry: equal for the same line of the file */
	const char *of;          /* a preset's name, "a rule" or "flaky" */
	enum score_gate_id gate; /* for a bar: its gate */
	int figure;              /* for a bar: index of the gate's figure */
	double fail;             /* for a bar: the file's limit; NAN: none for failing */
	unsigned flaky_gates;    /* otherwise, bit g: gate g may fail */
	const char *reason;      /* why; NULL: a bar */
};

/** Call `visit` with each entry that applies to a frame, in the order of the file. */
void score_rules_visit(const struct score_rules *settings, const char *name, uint64_t frame,
                       void (*visit)(void *user, const struct score_rules_entry *entry), void *user);

/** The folder of approved frames that the file names, resolved relative to the file; NULL: none. Borrowed. */
const char *score_rules_baseline(const struct score_rules *settings);

/**
 * Find the settings of one frame.
 *
 * @param settings  NULL: only those of the command line
 * @param name      the recording's name, matched by the globs ("gears")
 * @param base      settings of the command line, which rules then override
 * @param size      width and height of the frame, for masks and rectangles
 * @param out       all zero; free with score_rules_frame_free; must not move while options are in use
 * @return 0, ERR_INPUT (reported: a mask of another size, or too many bars) or ERR_SYSTEM (reported)
 */
int score_rules_for_frame(const struct score_rules *settings, const char *name, uint64_t frame,
                          const struct score_options *base, const uint32_t size[2], struct score_rules_frame *out);

/**
 * Ignore pixels that a picture's file does not contain.
 * @param outside  [height][width]: 1 for such pixels; NULL: none
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_rules_ignore_outside(struct score_rules_frame *frame, const uint8_t *outside, size_t n_pixels);

void score_rules_frame_free(struct score_rules_frame *frame);
