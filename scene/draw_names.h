/*
 * Names of draws, for reports: what a draw number of a frame was in its recording. replay/ hands them out, and a report
 * that takes them needs no replay.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct draw_name {
	uint64_t frame; /* asked for */
	uint32_t draw;  /* asked for; as in scene_instance */

	const char *call;     /* name of the call, a static string; NULL: not known, and nothing below is */
	uint64_t call_number; /* in the trace */
	int has_program;      /* 1: it used a program object */
	uint32_t list;        /* display list that it came from; 0: none */
	uint64_t texture;     /* XXH64 of the texels of its first texture unit; 0: none */
	const char *known;    /* where Mesa is known to depart from OpenGL there, a static string; NULL: nowhere */
};

/**
 * Fill in names; those that the trace does not tell stay unnamed.
 * @param names  sorted by frame
 */
typedef void draw_namer(const char *trace, struct draw_name *names, size_t n);
