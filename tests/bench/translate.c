/*
 * translate: time to compile a pair of shaders from text to instructions (make show-programs). Prints the milliseconds
 * of the first time and the median of later ones, as processor time of this process.
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "replay/glsl/translate.h"

#define TIMES 21

static const char *const vertices[] = { "varying vec3 n, v; void main() { n = gl_NormalMatrix * gl_Normal; v = "
	                                "vec3(gl_ModelViewMatrix * gl_Vertex); gl_Position = ftransform(); }" };
static const char *const fragments[] = {
	"varying vec3 n, v; void main() { vec3 m = normalize(n), e = normalize(-v); vec4 c = "
	"gl_FrontLightModelProduct.sceneColor;\n"
	"for (int i = 0; i < 4; i++) { vec3 l = normalize(gl_LightSource[i].position.xyz - v); float d = max(dot(m, "
	"l), 0.0);\n"
	"c += gl_FrontLightProduct[i].ambient + gl_FrontLightProduct[i].diffuse * d;\n"
	"c += gl_FrontLightProduct[i].specular * pow(max(dot(reflect(-l, m), e), 0.0), gl_FrontMaterial.shininess); }\n"
	"gl_FragColor = mix(gl_Fog.color, c, clamp((gl_Fog.end + v.z) * gl_Fog.scale, 0.0, 1.0)); }"
};

static double processor_ms(void)
{
	struct timespec t;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

int main(void)
{
	const struct glsl_sources sources = { .texts = { vertices, fragments }, .n_texts = { 1, 1 } };
	double took[TIMES];

	for (int i = 0; i < TIMES; i++) {
		struct program_code code[2] = { 0 };
		struct glsl_uniforms uniforms = { 0 };
		const char *why = NULL;
		char message[GLSL_MESSAGE];
		const double begin = processor_ms();

		if (glsl_translate(&sources, code, &uniforms, message, &why) || why) {
			fprintf(stderr, "translate: %s\n", why ? why : "failed");
			return 1;
		}
		took[i] = processor_ms() - begin;
		program_code_free(&code[0]);
		program_code_free(&code[1]);
		glsl_uniforms_free(&uniforms);
	}
	qsort(took + 1, TIMES - 1, sizeof(took[0]), compare);
	printf("%g %g\n", took[0], took[TIMES / 2]);
	return 0;
}
