/*
 * Round holes in a grid, on surfaces where rules set `cut: 1` (cutout.look.yaml). Holes for the camera are also
 * holes for mirrors and light. The grid is in object space and moves with the object.
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
