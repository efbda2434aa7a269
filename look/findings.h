/*
 * Findings: rules (look/rules.h) that a study proposes, each with a role, a confidence and a reason.
 *
 * rules_from_findings (look/rules.h) applies them to scenes; findings_write saves them for rules_load. A number has the
 * digits of the file in both cases, so the pictures are the same.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { FINDING_MOST_NUMBERS = 16, FINDING_MOST_VALUES = 14 };

/** The keys at the top level of a rule file, in the order of the file. */
enum findings_list {
	FINDINGS_SURFACES, FINDINGS_UNSEEN, FINDINGS_LIGHTS, FINDINGS_SKY, FINDINGS_GLOSS, FINDINGS_WORLD, N_FINDINGS_LISTS
};

enum finding_type { FINDING_TRUTH, FINDING_COUNT, FINDING_NUMBERS, FINDING_HASH, FINDING_WORD, FINDING_TEXT, FINDING_QUOTED };

/** Its key. */
const char *findings_key(enum findings_list list);

/** A key of a rule and its value. */
struct finding_value {
	const char *key; /* must outlive the findings; NULL: no value, which is skipped */
	enum finding_type type;
	int is_match;   /* 1: a test of `match` */
	uint64_t count; /* FINDING_COUNT; FINDING_TRUTH: 0 or 1 */
	uint64_t hash[2];
	double numbers[FINDING_MOST_NUMBERS];
	unsigned n;        /* count of numbers; 0: one number instead of a list */
	int digits;        /* significant digits of each number; negative: digits after the point, zeros included */
	int is_place;      /* 1: the fourth number is 1 for a place, 0 for a direction, without decimals */
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
	struct finding_value values[FINDING_MOST_VALUES]; /* in the order of the file; tests of `match` follow each other */
	unsigned n;
};

/** Comments at the top of the file. */
struct findings_summary {
	size_t frames;        /* that were studied */
	uint64_t first, last; /* their numbers */
	size_t known, moved;  /* frames whose camera is known, and where it moved */
	double percent;       /* how much of what is seen again, by size, stands still; mean of the known frames */
	size_t still, moving, carried, once; /* meshes; carried: with the viewer; once: in one frame only */
	size_t deforming;     /* shapes */
};

/** All zero: none. */
struct findings {
	struct findings_summary summary;
	struct finding *list;
	size_t n, room;
	struct finding lost; /* takes the values of a finding there is no memory for */
	int err;             /* 0 or ERR_SYSTEM (reported) */
};

/**
 * Add a finding, as the last of its list.
 * @param role  a printf format; NULL: it has no role
 * @return valid until the next one is added. Never NULL: findings_check returns the failure
 */
struct finding *findings_add(struct findings *findings, enum findings_list list, const char *role, ...)
	__attribute__((format(printf, 3, 4)));

/** Add values. They are copied; a text is taken over. */
void finding_set(struct finding *finding, const struct finding_value *values, size_t n);
#define FINDING_SET(finding, ...) \
	finding_set(finding, (const struct finding_value[]){ __VA_ARGS__ }, \
	            sizeof((const struct finding_value[]){ __VA_ARGS__ }) / sizeof(struct finding_value))

/** Add tests of `match`, likewise. */
void finding_match(struct finding *finding, const struct finding_value *values, size_t n);
#define FINDING_MATCH(finding, ...) \
	finding_match(finding, (const struct finding_value[]){ __VA_ARGS__ }, \
	              sizeof((const struct finding_value[]){ __VA_ARGS__ }) / sizeof(struct finding_value))

/** Add `confidence`, with two decimals, and `why`. @param why  a printf format */
void finding_explain(struct finding *finding, double confidence, const char *why, ...)
	__attribute__((format(printf, 3, 4)));

/** Add `why` alone. */
void finding_say(struct finding *finding, const char *why, ...) __attribute__((format(printf, 2, 3)));

/** After the last one. @return 0 or ERR_SYSTEM (reported): memory was short, and the findings must not be used */
int findings_check(const struct findings *findings);

/** The text of a number, as the file has it. @param i  index in value->numbers */
void finding_print_number(const struct finding_value *value, unsigned i, char out[64]);

/** The text of a hash: 32 hexadecimal digits. */
void finding_print_hash(const uint64_t hash[2], char out[33]);

/** Write the file. @param trace  the recording's name, for a comment */
void findings_write(const struct findings *findings, const char *trace, FILE *out);
void findings_free(struct findings *findings);
