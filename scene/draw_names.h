/*
 * Names of draws for reports: the call in the recording behind a draw number. replay/ provides them through a function
 * pointer, so a report needs no replay.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct draw_name {
	uint64_t frame; /* asked for */
	uint32_t draw;  /* asked for; as in scene_instance */

	const char *call;     /* name of the call, a static string; NULL: not known, and the members below mean nothing */
	uint64_t call_number; /* in the trace */
	int has_program;      /* 1: the draw used a program object */
	uint32_t list;        /* display list that made the call; 0: none */
	uint64_t texture;     /* XXH64 of the texels of its first texture unit; 0: none */
	const char *known;    /* a known departure of Mesa from OpenGL at this draw, a static string; NULL: none */
};

/**
 * Fill in names; those that the trace does not give stay unnamed.
 * @param names  sorted by frame
 */
typedef void draw_namer(const char *trace, struct draw_name *names, size_t n);
