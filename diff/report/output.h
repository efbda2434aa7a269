/*
 * The result of a comparison: helpers for all output formats (summary.h, table.h, junit.h, markdown.h), JSON, and
 * workflow commands.
 */
#pragma once

#include <stdio.h>

#include "diff/pictures/set.h"
#include "diff/rules/rules.h"
#include "diff/score/score.h"

/* A complete comparison. */
struct output_run {
	const char *reference, *traced; /* as the user named them; reference NULL: approved frames only */
	const struct set *ref, *set;    /* sets compared; NULL: not known */
	const char *baseline;           /* folder of approved frames, NULL: none */
	const char *name;               /* the recording's name, which configurations match */
	const char *command;            /* the command line of this run */
	const char *film;               /* a film of 'relume film' for the page to play; NULL: none */
	const struct score_options *options; /* from the command line */
	const struct score_rules *settings;     /* NULL: none */
	struct score *scores;           /* sorted by frame */
	size_t n_scores;
	uint64_t counts[N_SCORE_OUTCOMES];
	uint64_t n_unmatched;           /* frames that have no traced one and were not asked for: not counted */
	double seconds;
};

/** 1 if the frame exists and was compared. */
int output_is_compared(const struct score *s);

/** A gate's figures with their bars, "interior pixels over 2/255: 0.31 % (bar 0.1 %)", NUL-terminated. */
void output_gate_text(const struct score *s, enum score_gate_id id, char *out, size_t size);

/** 1 if a picture was matched by its path, so its number means nothing to people. */
int output_is_named(const struct output_run *run, uint64_t frame);

/** "frame 12", or the name of a picture without a number, NUL-terminated. */
void output_name(const struct output_run *run, uint64_t frame, char *out, size_t size);

/** The file of a frame in a set ("the frames in NAME.ref"); NULL: none. */
const char *output_file(const struct set *set, uint64_t frame);

/** "draw 12, glDrawElements (call 345), list 3, texture 0123..., in the approved frame", NUL-terminated. */
void output_blame_text(const struct score_blame *b, char *out, size_t size);

/** 1 if a gate of the frame warns. */
int output_has_warning(const struct score *s);

/** The lowest frame number that failed or is missing; NULL if none. */
const struct score *output_first_wrong(const struct output_run *run);

/**
 * Write JSON with every figure and bar. Numbers that were not measured or are infinite are null.
 * @return 0 or ERR_SYSTEM (reported)
 */
int output_json(const struct output_run *run, const char *path);
void output_json_stream(const struct output_run *run, FILE *out);

/** Print workflow commands: an ::error line for each frame that did not pass, a ::warning line for each that warns. */
void output_annotations(const struct output_run *run, FILE *out);

