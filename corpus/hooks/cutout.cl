/*
 * Round holes in a grid, in whatever rules say `cut: 1` about (cutout.look.yaml). What is a hole for the camera
 * is one for mirrors and for light, too. The grid lies in the object's own space and moves with it.
 */
#pragma relume parameter int cut = 0
#pragma relume parameter float spacing = 0.5
#pragma relume parameter float radius = 0.35

struct relume_request any_hit(struct relume_hit hit, struct relume_parameters parameters)
{
	const float4 at = relume_object_position(&hit) / parameters.spacing, cell = at - rint(at);

	if (!parameters.cut)
		return relume_go_on();
	return length(cell) < parameters.radius ? relume_ignore() : relume_go_on();
}
