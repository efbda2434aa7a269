/* Keywords (GLSL 1.50 sec. 3.6), and the versions that introduced them. */
#pragma once

#include <stdint.h>

enum parse_keyword {
	PARSE_NO_KEYWORD,
	PARSE_RESERVED,
	PARSE_TYPE_NAME,
	PARSE_ATTRIBUTE,
	PARSE_CONST,
	PARSE_UNIFORM,
	PARSE_VARYING,
	PARSE_CENTROID,
	PARSE_FLAT,
	PARSE_SMOOTH,
	PARSE_NOPERSPECTIVE,
	PARSE_LAYOUT,
	PARSE_IN,
	PARSE_OUT,
	PARSE_INOUT,
	PARSE_INVARIANT,
	PARSE_PRECISION,
	PARSE_PRECISE,
	PARSE_BREAK,
	PARSE_CONTINUE,
	PARSE_DO,
	PARSE_FOR,
	PARSE_WHILE,
	PARSE_SWITCH,
	PARSE_CASE,
	PARSE_DEFAULT,
	PARSE_IF,
	PARSE_ELSE,
	PARSE_DISCARD,
	PARSE_RETURN,
	PARSE_STRUCT,
	PARSE_TRUE,
	PARSE_FALSE,
	PARSE_UNSIGNED,
	PARSE_LOWP,
	PARSE_SUBROUTINE
};

/** The keyword that a text is in any version: enum parse_keyword */
uint32_t parse_keyword_of(const char *text);

/** The version that introduced a keyword; before it the word is an ordinary name. */
uint32_t parse_keyword_version(uint32_t keyword);
