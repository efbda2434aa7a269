/*
 * relume-diff.yaml: how frames are compared, by recording and by frame. diff/rules/README.md shows its form.
 *
 * Every rule that matches applies, in the order of the file. A preset applies before the rule that names it, and a preset that it
 * inherits before that. Later bars win; lists of rectangles and channels add up.
 */
#pragma once

#include "diff/score/score.h"

struct score_rules; /* opaque */

enum { SCORE_RULES_MAX_BARS = 64, SCORE_RULES_MAX_CHANNELS = 64 };

/* What holds for one frame; points into the settings. */
struct score_rules_frame {
	struct score_options options;
	struct score_bar bars[SCORE_RULES_MAX_BARS];
	const char *channels[SCORE_RULES_MAX_CHANNELS];
	uint8_t *ignore;            /* [height][width], owned; NULL: nothing is ignored */
	unsigned flaky_gates;       /* bit g: gate g is known to be flaky here */
	const char *flaky_reason;   /* of the last entry that matched; NULL: none */
};

/**
 * Read a file. Unknown keys, wrong types, unknown presets, bad ranges and dates, unreadable masks are errors.
 * @return 0, ERR_INPUT (reported, with the line where it can be told) or ERR_SYSTEM (reported)
 */
int score_rules_read(const char *path, struct score_rules **out);
void score_rules_free(struct score_rules **settings);

/* What a file allows for a frame: a bar in place of the default one, or gates that may fail. */
struct score_rules_entry {
	const void *key;         /* the same for the same line of the file */
	const char *of;          /* a preset's name, "a rule" or "flaky" */
	enum score_gate_id gate; /* a bar: whose, */
	int figure;              /* which figure, */
	double fail;             /* and what the file says; NAN: it says nothing about failing */
	unsigned flaky_gates;    /* else: bit g: gate g may fail */
	const char *reason;      /* why; NULL: a bar */
};

/** Call `visit` with each entry that applies to a frame, in the order of the file. */
void score_rules_visit(const struct score_rules *settings, const char *name, uint64_t frame,
                       void (*visit)(void *user, const struct score_rules_entry *entry), void *user);

/** The folder of approved frames that the file names, relative to where the file lies; NULL: none. Borrowed. */
const char *score_rules_baseline(const struct score_rules *settings);

/**
 * Work out what holds for one frame.
 *
 * @param settings  NULL: nothing but what the command line says
 * @param name      of the recording, matched by the globs ("gears")
 * @param base      what the command line says; copied, then changed by the rules
 * @param size      width and height of the frame, for masks and rectangles
 * @param out       all zero; free with score_rules_frame_free; must not move while options are in use
 * @return 0, ERR_INPUT (reported: a mask of another size, or too many bars) or ERR_SYSTEM (reported)
 */
int score_rules_for_frame(const struct score_rules *settings, const char *name, uint64_t frame,
                          const struct score_options *base, const uint32_t size[2], struct score_rules_frame *out);

/**
 * Ignore pixels that a picture's file does not have.
 * @param outside  [height][width]: 1 there; NULL: none
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_rules_ignore_outside(struct score_rules_frame *frame, const uint8_t *outside, size_t n_pixels);

void score_rules_frame_free(struct score_rules_frame *frame);
