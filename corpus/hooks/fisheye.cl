/* A fisheye camera: angles from the middle of the view grow evenly towards the border of a disk; nothing is visible
 * beyond it. */
#pragma relume parameter float degrees = 180

struct relume_ray ray_generation(struct relume_pixel pixel, struct relume_parameters parameters)
{
	const float radius = 0.5f * min(pixel.width, pixel.height);
	const float x = (pixel.x - 0.5f * pixel.width) / radius, y = (0.5f * pixel.height - pixel.y) / radius,
		    r = sqrt(x * x + y * y);
	const float angle = r * 0.5f * parameters.degrees * 0.017453293f;
	struct relume_ray ray;

	ray.origin = (float4)(0.0f);
	ray.direction = (float4)(0.0f);
	if (r > 0.0f && r <= 1.0f)
		ray.direction = (float4)(x / r * sin(angle), y / r * sin(angle), -cos(angle), 0.0f);
	else if (r == 0.0f)
		ray.direction.z = -1.0f;
	return ray;
}
