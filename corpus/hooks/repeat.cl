/* The built-in closest hit, said once more: the picture is the same to the bit. A start for hooks of one's own. */

struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters)
{
	return relume_color(hit.color);
}
