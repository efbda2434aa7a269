/*
 * A heat map of the cost of rays: the number of boxes of the binary trees that a ray tests on its way to the surface,
 * from blue over green and yellow to red at `most`. Use it to compare trees of other builders (--accel).
 */
#pragma relume parameter float most = 200

struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters)
{
	const float x = clamp(relume_box_tests(&hit) / parameters.most, 0.0f, 1.0f) * 4.0f;

	return relume_color(clamp((float4)(x - 2.0f, min(x, 4.0f - x), 2.0f - x, 0.0f), 0.0f, 1.0f));
}
