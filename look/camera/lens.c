#include "look/camera/lens.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "look/camera/camera.h"

#define HEAD "struct relume_ray ray_generation(struct relume_pixel pixel, struct relume_parameters parameters)\n"

/* x and y by equal angles. With two eyes, the left one's picture is above the right one's, and the eyes are on a
 * circle, on both sides of each column's direction (Ishiguro, Yamamoto and Tsuji 1992, "Omni-Directional Stereo"). */
static const char panorama[] =
	HEAD "{\n"
	"	const float rows = EYES > 0.0f ? 0.5f * pixel.height : pixel.height;\n"
	"	const int is_right = pixel.y >= rows;\n"
	"	const float y = is_right ? pixel.y - rows : pixel.y, side = 0.5f * (is_right ? EYES : -EYES);\n"
	"	const float lon = 6.2831853f * (pixel.x / pixel.width - 0.5f), lat = 3.1415927f * (0.5f - y / rows);\n"
	"	struct relume_ray ray;\n"
	"\n"
	"	ray.origin = (float4)(side * cos(lon), 0.0f, side * sin(lon), 0.0f);\n"
	"	ray.direction = (float4)(sin(lon) * cos(lat), sin(lat), -cos(lon) * cos(lat), 0.0f);\n"
	"	return ray;\n"
	"}\n";

/* Two eyes that look in the same direction, with windows shifted to coincide at a distance. */
static const char stereo[] =
	HEAD "{\n"
	"	const float columns = 0.5f * pixel.width;\n"
	"	const int is_right = pixel.x >= columns;\n"
	"	const float x = (is_right ? pixel.x - columns : pixel.x) - 0.5f * columns, y = 0.5f * pixel.height - pixel.y;\n"
	"	const float pixels = 2.0f * TANGENT / pixel.height * CONVERGE;\n"
	"	struct relume_ray ray;\n"
	"\n"
	"	ray.origin = (float4)(0.5f * (is_right ? EYES : -EYES), 0.0f, 0.0f, 0.0f);\n"
	"	ray.direction = (float4)(x * pixels, y * pixels, -CONVERGE, 0.0f) - ray.origin;\n"
	"	return ray;\n"
	"}\n";

/* Left, front, right, and below them down, back, up. The upper edge of down and the lower edge of up adjoin the
 * front. */
static const char cube[] =
	HEAD "{\n"
	"	const float width = pixel.width / 3.0f, height = 0.5f * pixel.height;\n"
	"	const int column = min((int)(pixel.x / width), 2), row = min((int)(pixel.y / height), 1);\n"
	"	const float a = 2.0f * (pixel.x / width - (float)column) - 1.0f;\n"
	"	const float b = 1.0f - 2.0f * (pixel.y / height - (float)row);\n"
	"	struct relume_ray ray;\n"
	"\n"
	"	ray.origin = (float4)(0.0f);\n"
	"	if (row == 0)\n"
	"		ray.direction = column == 0 ? (float4)(-1.0f, b, -a, 0.0f) :\n"
	"				column == 1 ? (float4)(a, b, -1.0f, 0.0f) : (float4)(1.0f, b, a, 0.0f);\n"
	"	else\n"
	"		ray.direction = column == 0 ? (float4)(a, -1.0f, -b, 0.0f) :\n"
	"				column == 1 ? (float4)(-a, b, 1.0f, 0.0f) : (float4)(a, 1.0f, b, 0.0f);\n"
	"	return ray;\n"
	"}\n";

/* A thin lens: rays start at a point on it and pass through the point where the pinhole's ray meets the plane in
 * focus. */
static const char thin[] =
	HEAD "{\n"
	"	const float4 sharp = pixel.ray.origin + pixel.ray.direction * ((FOCUS + pixel.ray.origin.z) /\n"
	"	                                                               -pixel.ray.direction.z);\n"
	"	const float angle = 6.2831853f * pixel.v, away = APERTURE * sqrt(pixel.u);\n"
	"	struct relume_ray ray;\n"
	"\n"
	"	ray.origin = (float4)(away * cos(angle), away * sin(angle), 0.0f, 0.0f);\n"
	"	ray.direction = sharp - ray.origin;\n"
	"	return ray;\n"
	"}\n";

static const char *text_of(const struct camera_keys *k)
{
	if (camera_is_kind(k, "panorama"))
		return panorama;
	if (camera_is_kind(k, "stereo"))
		return stereo;
	if (camera_is_kind(k, "cube"))
		return cube;
	return k->aperture && *k->aperture > 0 ? thin : NULL;
}

const char *lens_eyes(const struct camera *camera)
{
	const struct camera_keys *k = camera->keys;

	if (camera_is_kind(k, "stereo"))
		return "side by side";
	return camera_is_kind(k, "panorama") && k->eyes && *k->eyes > 0 ? "left above right" : NULL;
}

static double value_of(const float *key, double otherwise)
{
	return key ? (double)*key : otherwise;
}

int lens_text(const struct camera *camera, char **out)
{
	const struct camera_keys *k = camera->keys;
	const char *text = text_of(k);

	*out = NULL;
	if (!text)
		return 0;
	if (asprintf(out,
	             "#define EYES %.9ef\n#define TANGENT tan(%.9ef)\n#define CONVERGE %.9ef\n#define APERTURE %.9ef\n"
	             "#define FOCUS %.9ef\n%s",
	             value_of(k->eyes, 0), value_of(k->field_of_view, 60) * 0.5 * 0.017453292519943295,
	             value_of(k->converge, 10), value_of(k->aperture, 0), value_of(k->focus, 10), text) >= 0)
		return 0;
	*out = NULL;
	return err_report(ERR_SYSTEM, NULL, "out of memory");
}
