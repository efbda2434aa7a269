/*
 * The Mesa that drew what a recording's reference shows. The specification leaves much of drawing open, and llvmpipe
 * decides some of it otherwise from one version to the next. Relume draws as 22.3 does, but for the differences that
 * are listed here.
 */
#pragma once

#include <stdint.h>

/** Differences from Mesa 22.3, as bits. */
enum scene_mesa {
	/* 23.2: at an end right beside a pixel's centre, which pixel the quad of a line covers is known exactly */
	SCENE_MESA_LINE_ENDS = 1,
	/* 25.0: places and widths of lines and points that lie half way are rounded to even numbers */
	SCENE_MESA_ROUNDS_TO_EVEN = 2,
	/* 25.0: the middle of a point sprite is its middle under multisampling, too */
	SCENE_MESA_SPRITES = 4,
	/* 25.0: smooth lines are turned without angles, and cover no more than their length where they are short */
	SCENE_MESA_SMOOTH_LINES = 8,
	/* 25.0, no more in 26.1: COLOR_SUM adds the current secondary colour to bitmaps */
	SCENE_MESA_BITMAP_SUMS = 16,
	/* 25.0: ShadeModel holds for the colours that fragment programs in assembly read, too */
	SCENE_MESA_FLAT_PROGRAMS = 32,
	/* 25.0: colours of back sides alone that are the vertices' are theirs */
	SCENE_MESA_BACK_COLORS = 64,
	/* 25.0: bitmaps are drawn late, with the fog that is set then: known, not followed (replay/draw_names.c) */
	SCENE_MESA_LATE_BITMAPS = 128,
	/* 25.0: GLSL's (A B C) v is (A B) (C v), and not A (B (C v)): products are taken apart once */
	SCENE_MESA_PRODUCTS_ONCE = 256,
	/* 25.0: pixels that become floats of 10 and 11 bits are rounded, and not cut off; what is drawn to them still
	   is */
	SCENE_MESA_ROUNDS_SMALL_FLOATS = 512,
	/* 25.0: levels of encoded luminance are means in linear light, and not of what is stored */
	SCENE_MESA_LINEAR_MEANS = 1024,
	/* 25.0: GL_MESA_ycbcr_texture is gone: llvmpipe samples no such format, and what names one is refused */
	SCENE_MESA_LACKS_YCBCR = 2048,
	/* another GL: it has what every Mesa lacks (glPolygonOffsetEXT) */
	SCENE_MESA_IS_OTHER = 4096,
	/* 25.0: with COLOR_MATERIAL, lighting takes the current colour, and no parameter that waits
	   (replay/gl/geometry/waiting.h) */
	SCENE_MESA_TRACKS_COLORS = 8192,
};

/**
 * The differences of the GL that calls itself so.
 * @param gl  its version and renderer, as glGetString gives them:
 *            "4.5 (Compatibility Profile) Mesa 25.0.7, llvmpipe (...)"
 * @return bits of enum scene_mesa; 0 for 22.3, for older ones, for Mesa without llvmpipe, and where nothing is said
 */
uint32_t scene_mesa_of(const char *gl);
