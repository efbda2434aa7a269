/*
 * Findings: rules (look/rules/rules.h) proposed by a study, each with a role, a confidence and a reason.
 *
 * rules_from_findings (look/rules/rules.h) applies them to scenes; findings_write saves them for rules_load. Either
 * way, numbers have the precision of the file, so the pictures are the same.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { FINDING_MOST_NUMBERS = 16, FINDING_MOST_VALUES = 14 };

/** The lists of a rule file, in the order of the file. */
enum findings_list {
	FINDINGS_SURFACES, FINDINGS_UNSEEN, FINDINGS_LIGHTS, FINDINGS_SKY, FINDINGS_GLOSS, FINDINGS_WORLD,
	N_FINDINGS_LISTS
};

enum finding_type {
	FINDING_TRUTH, FINDING_COUNT, FINDING_NUMBERS, FINDING_HASH, FINDING_WORD, FINDING_TEXT, FINDING_QUOTED
};

/** The key of a list in the file. */
const char *findings_key(enum findings_list list);

/** A key of a rule and its value. */
struct finding_value {
	const char *key; /* must outlive the findings; NULL: skipped */
	enum finding_type type;
	int is_match;   /* 1: a test of `match` */
	uint64_t count; /* FINDING_COUNT; FINDING_TRUTH: 0 or 1 */
	uint64_t hash[2];
	double numbers[FINDING_MOST_NUMBERS];
	unsigned n;        /* length of the list of numbers; 0: a single number, which is not a list */
	int digits;        /* significant digits of each number; negative: digits after the point, zeros included */
	int is_place;      /* 1: the fourth number is 1 for a position or 0 for a direction, and has no decimals */
	const char *word;  /* must outlive the findings */
	char *text;        /* freed with the findings; NULL: out of memory */
};

#define FINDING_IS(name, is) { .key = name, .type = FINDING_TRUTH, .count = (is) != 0 }
#define FINDING_COUNTED(name, x) { .key = name, .type = FINDING_COUNT, .count = x }
#define FINDING_NAMED(name, x) { .key = name, .type = FINDING_WORD, .word = x }
#define FINDING_HASHED(name, x) { .key = name, .type = FINDING_HASH, .hash = { (x)[0], (x)[1] } }
#define FINDING_NUMBER(name, n_digits, x) \
	{ .key = name, .type = FINDING_NUMBERS, .digits = n_digits, .numbers = { x } }
#define FINDING_VECTOR(name, n_digits, x, y, z) \
	{ .key = name, .type = FINDING_NUMBERS, .digits = n_digits, .n = 3, .numbers = { x, y, z } }
#define FINDING_PLANE(name, p) \
	{ .key = name, .type = FINDING_NUMBERS, .digits = 7, .n = 4, .numbers = { (p)[0], (p)[1], (p)[2], (p)[3] } }
#define FINDING_PLACE(name, n_digits, p, w) \
	{ .key = name, .type = FINDING_NUMBERS, .digits = n_digits, .is_place = 1, .n = 4, \
	  .numbers = { (p)[0], (p)[1], (p)[2], w } }

struct finding {
	enum findings_list list;
	struct finding_value values[FINDING_MOST_VALUES]; /* in the order of the file; the tests of `match` are
	                                                     adjacent */
	unsigned n;
};

/** Comments at the top of the file. */
struct findings_summary {
	size_t frames;        /* that were studied */
	uint64_t first, last; /* their numbers */
	size_t known, moved;  /* frames whose camera is known, and where it moved */
	double percent;       /* share, by size, of the meshes seen again that stand still; mean of the known frames */
	size_t still, moving, carried, once; /* numbers of meshes; carried: with the viewer; once: in one frame only */
	size_t deforming;     /* number of shapes */
};

/** All zero: empty. */
struct findings {
	struct findings_summary summary;
	struct finding *list;
	size_t n, room;
	struct finding lost; /* findings_add returns it if memory is short; its values are dropped */
	int err;             /* 0 or ERR_SYSTEM (reported) */
};

/**
 * Add a finding to the end of its list.
 * @param role  a printf format; NULL: no role
 * @return the finding, valid until the next call. Never NULL: findings_check reports the failure
 */
struct finding *findings_add(struct findings *findings, enum findings_list list, const char *role, ...)
	__attribute__((format(printf, 3, 4)));

/** Add values. They are copied, except that the finding takes ownership of each `text`. */
void finding_set(struct finding *finding, const struct finding_value *values, size_t n);
#define FINDING_SET(finding, ...) \
	finding_set(finding, (const struct finding_value[]){ __VA_ARGS__ }, \
	            sizeof((const struct finding_value[]){ __VA_ARGS__ }) / sizeof(struct finding_value))

/** Add tests of `match` in the same way. */
void finding_match(struct finding *finding, const struct finding_value *values, size_t n);
#define FINDING_MATCH(finding, ...) \
	finding_match(finding, (const struct finding_value[]){ __VA_ARGS__ }, \
	              sizeof((const struct finding_value[]){ __VA_ARGS__ }) / sizeof(struct finding_value))

/** Add `confidence`, with two decimals, and `why`. @param why  a printf format */
void finding_explain(struct finding *finding, double confidence, const char *why, ...)
	__attribute__((format(printf, 3, 4)));

/** Add `why` alone. */
void finding_say(struct finding *finding, const char *why, ...) __attribute__((format(printf, 2, 3)));

/** Call after the last finding. @return 0 or ERR_SYSTEM (reported): memory ran out, so do not use the findings */
int findings_check(const struct findings *findings);

/** The text of a number in the file. @param i  index in value->numbers */
void finding_print_number(const struct finding_value *value, unsigned i, char out[64]);

/** Write the file. @param trace  the recording's name, for a comment */
void findings_write(const struct findings *findings, const char *trace, FILE *out);
void findings_free(struct findings *findings);
