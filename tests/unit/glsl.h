/*
 * Shared by tests of GLSL's front end: whether texts are accepted, and initial values of uniforms (GLSL 1.20 sec.
 * 4.3.5).
 */
#pragma once

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "replay/glsl/parse/parse.h"
#include "tests/case.h"

#define MAIN "void main() { gl_FragColor = vec4(r); }\n"

static char message[GLSL_MESSAGE];

/* Why a stage with these texts is refused, or NULL if it is not. */
static inline const char *why_of(enum glsl_stage stage, const char *const *texts, uint32_t n)
{
	struct glsl_tree tree = { 0 };
	const char *why;

	ck_assert_int_eq(glsl_parse(texts, n, stage, false, &tree, message, &why), 0);
	glsl_tree_free(&tree);
	return why;
}

static inline void check_why(enum glsl_stage stage, const char *text, const char *wanted)
{
	const char *why = why_of(stage, &text, 1);

	if (!wanted)
		ck_assert_msg(!why, "%s\n%s", text, why);
	else
		ck_assert_msg(why && strstr(why, wanted), "%s\n%s, not %s", text, why ? why : "taken", wanted);
}

static inline void check_refused(const char *text, const char *wanted)
{
	check_why(GLSL_FRAGMENT_STAGE, text, wanted);
}
static inline void check_taken(const char *text)
{
	check_why(GLSL_FRAGMENT_STAGE, text, NULL);
}

/* The initial value of the uniform r. */
static inline double value_in(const char *text)
{
	struct glsl_tree tree = { 0 };
	const char *why;
	double value = NAN;

	ck_assert_int_eq(glsl_parse(&text, 1, GLSL_FRAGMENT_STAGE, false, &tree, message, &why), 0);
	ck_assert_msg(!why, "%s\n%s", text, why);
	for (uint32_t i = 0; i < tree.n_symbols; i++)
		if (strcmp(tree.names + tree.symbols[i].name, "r") == 0 && tree.symbols[i].first != GLSL_NONE)
			value = tree.numbers[tree.symbols[i].first];
	glsl_tree_free(&tree);
	return value;
}

/* lines: the text before the declaration of r. */
static inline void check_value(const char *version, const char *lines, const char *expression, double wanted)
{
	char text[1024];
	double value;

	snprintf(text, sizeof(text), "#version %s\n%s\nuniform float r = float(%s);\n" MAIN, version, lines,
	         expression);
	value = value_in(text);
	ck_assert_msg(value == wanted || fabs(value - wanted) < 1e-6 * fabs(wanted), "%s: %.9g, not %.9g", expression,
	              value, wanted);
}
