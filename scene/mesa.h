/*
 * The Mesa version that drew a recording's reference. The specification leaves much of rasterization open, and llvmpipe
 * resolves some of it differently from one version to the next. Relume draws as 22.3 does, except for the differences
 * listed here.
 */
#pragma once

#include <stdint.h>

/** Differences from Mesa 22.3, as bits. */
enum scene_mesa {
	/* 23.2: if a line ends right beside a pixel's centre, the pixel that its quad covers is decided exactly */
	SCENE_MESA_LINE_ENDS = 1,
	/* 25.0: positions and widths of lines and points that lie half way are rounded to even */
	SCENE_MESA_ROUNDS_TO_EVEN = 2,
	/* 25.0: a point sprite's middle stays its middle under multisampling */
	SCENE_MESA_SPRITES = 4,
	/* 25.0: smooth lines are rotated without angles, and short ones cover no more than their length */
	SCENE_MESA_SMOOTH_LINES = 8,
	/* 25.0, but not 26.1: COLOR_SUM adds the current secondary colour to bitmaps */
	SCENE_MESA_BITMAP_SUMS = 16,
	/* 25.0: ShadeModel also applies to colours that fragment programs in assembly read */
	SCENE_MESA_FLAT_PROGRAMS = 32,
	/* 25.0: with COLOR_MATERIAL for GL_BACK alone, back sides take their vertices' colours */
	SCENE_MESA_BACK_COLORS = 64,
	/* 25.0: bitmaps are drawn late, with the fog state of that time: known, not followed (replay/draw_names.c) */
	SCENE_MESA_LATE_BITMAPS = 128,
	/* 25.0: GLSL's (A B C) v is (A B) (C v), not A (B (C v)): products are taken apart once */
	SCENE_MESA_PRODUCTS_ONCE = 256,
	/* 25.0: pixels converted to floats of 10 and 11 bits are rounded, not truncated; drawing to them still
	 * truncates */
	SCENE_MESA_ROUNDS_SMALL_FLOATS = 512,
	/* 25.0: levels of encoded luminance are means in linear light, not of the stored values */
	SCENE_MESA_LINEAR_MEANS = 1024,
	/* 25.0: GL_MESA_ycbcr_texture is gone: llvmpipe samples no such format, and calls that name one fail */
	SCENE_MESA_LACKS_YCBCR = 2048,
	/* another GL, with a feature that every Mesa lacks (glPolygonOffsetEXT) */
	SCENE_MESA_IS_OTHER = 4096,
	/* 25.0: with COLOR_MATERIAL, lighting uses the current colour, and no pending parameter
	 * (replay/gl/geometry/waiting.h) */
	SCENE_MESA_TRACKS_COLORS = 8192,
	/* 25.0: bitmaps whose pixels are NULL are kept in display lists */
	SCENE_MESA_KEEPS_BITMAPS = 16384,
};

/**
 * The differences of a GL, by its version string.
 * @param gl  version and renderer as glGetString gives them: "4.5 (Compatibility Profile) Mesa 25.0.7, llvmpipe (...)"
 * @return bits of enum scene_mesa; 0 for 22.3 and older, for Mesa without llvmpipe, and for no version
 */
uint32_t scene_mesa_of(const char *gl);
