/* Vertices in the window (clip.h, one_lanes.h). All lanes share one view. */

/* Window position of a vertex, in pixels, y from the top: Mesa draws to a window with y pointing down. */
LANES void clip_place(GLOBAL const struct view *view, VEC4 clip, float height, REAL *place)
{
	const float half_x = view->viewport[2] * 0.5f, half_y = view->viewport[3] * 0.5f;
	REAL w_inv = 1.0f / clip.w;

	place[0] = M_FMA(SAME(half_x), clip.x * w_inv, SAME(view->viewport[0] + half_x));
	place[1] = M_FMA(SAME(-half_y), clip.y * w_inv, SAME(height - (view->viewport[1] + half_y)));
}

/* The planes that a point is outside of: a bit for each, in clipping order. */
LANES WORD clip_outside(VEC4 c)
{
	const WORD none = (WORD)(0u);

	return CHOOSE(c.x <= c.w, none, (WORD)(1u)) | CHOOSE(c.x + c.w >= 0.0f, none, (WORD)(2u)) |
	       CHOOSE(c.y <= c.w, none, (WORD)(4u)) | CHOOSE(c.y + c.w >= 0.0f, none, (WORD)(8u)) |
	       CHOOSE(c.z + c.w >= 0.0f, none, (WORD)(16u)) | CHOOSE(c.z <= c.w, none, (WORD)(32u));
}

LANES MASK clip_is_safe(const REAL *place)
{
	return M_ABS(place[0]) < CLIP_SAFE_PIXELS && M_ABS(place[1]) < CLIP_SAFE_PIXELS;
}

/*
 * Window coordinates in 1/256 pixel. Halves round in Mesa's direction of y: values are snapped in that direction, then
 * flipped.
 */
LANES struct LANED(window_vertex) clip_snap(const REAL *place, REAL z, REAL w_inv, float height)
{
	struct LANED(window_vertex) out;

	out.x = TO_INT(ROUND((place[0] - 0.5f) * 256.0f)) + 128;
	out.y = (int32_t)height * 256 - (TO_INT(ROUND((place[1] - 0.5f) * 256.0f)) + 128);
	out.z = z;
	out.w_inv = w_inv;
	return out;
}

/* Window vertex of one of the program's vertices; all 0 if it is outside the view volume. */
LANES struct LANED(window_vertex) clip_window(GLOBAL const struct view *view, VEC4 clip, float height)
{
	const float near = view->depth_range[0], far = view->depth_range[1];
	REAL w_inv = 1.0f / clip.w, place[2];
	struct LANED(window_vertex) out;
	MASK is_there;

	clip_place(view, clip, height, place);
	is_there = clip.w > 0.0f && clip_outside(clip) == 0u && clip_is_safe(place);
	out.x = out.y = (INT)(0);
	out.z = out.w_inv = SAME(0.0f);
	if (ANY(is_there)) {
		const REAL z = M_FMA(SAME((far - near) * 0.5f), clip.z * w_inv, SAME((far + near) * 0.5f));
		const struct LANED(window_vertex) snapped = clip_snap(place, z, w_inv, height);

		out.x = CHOOSE(is_there, snapped.x, out.x);
		out.y = CHOOSE(is_there, snapped.y, out.y);
		out.z = CHOOSE(is_there, snapped.z, out.z);
		out.w_inv = CHOOSE(is_there, snapped.w_inv, out.w_inv);
	}
	return out;
}
