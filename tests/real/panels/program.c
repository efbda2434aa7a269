/* ARB_fragment_program: each instruction, operand, binding and option, on a tilted square. */
#include "programs.h"

/* Set a fragment program for the following draws. */
static void shade(const char *text)
{
	set_program(GL_FRAGMENT_PROGRAM_ARB, "!!ARBfp1.0", text);
	glBindTexture(GL_TEXTURE_2D, images[0]);
	glActiveTexture(GL_TEXTURE1);
	glBindTexture(GL_TEXTURE_2D, images[1]);
	glBindTexture(GL_TEXTURE_CUBE_MAP, images[2]);
	glBindTexture(GL_TEXTURE_1D, images[3]);
	glActiveTexture(GL_TEXTURE0);
}

/* Each instruction, with inputs below 0 and above 1; saturated or not, writing all components or two. */
static void instruction(int i)
{
	static const char *const forms[30] = {
		"ABS%s r%s, a;",
		"ADD%s r%s, a, b;",
		"CMP%s r%s, a, b, -a;",
		"COS%s r%s, a.x;",
		"DP3%s r%s, a, b;",
		"DP4%s r%s, a, b;",
		"DPH%s r%s, a, b;",
		"DST%s r%s, a, b;",
		"EX2%s r%s, a.y;",
		"FLR%s r%s, a;",
		"FRC%s r%s, a;",
		"LG2%s r%s, |.x;",
		"LIT%s r%s, a;",
		"LRP%s r%s, a, b, -a;",
		"MAD%s r%s, a, b, a.wzyx;",
		"MAX%s r%s, a, b;",
		"MIN%s r%s, a, b;",
		"MOV%s r%s, a.yxwz;",
		"MUL%s r%s, a, -b;",
		"POW%s r%s, |.x, b.y;",
		"RCP%s r%s, a.w;",
		"RSQ%s r%s, |.y;",
		"SCS%s r%s, b.x;",
		"SGE%s r%s, a, b;",
		"SIN%s r%s, a.x;",
		"SLT%s r%s, a, b;",
		"SUB%s r%s, a, b;",
		"XPD%s r%s, a, b;",
		"SWZ%s r%s, a, -y, 1, 0, x;",
		"MOV%s r%s, -a.z;",
	};
	static const char *const masks[2] = { "", ".xz" };
	const int form = choose(&i, 30), saturates = choose(&i, 2), mask = choose(&i, 2);
	char text[512], one[128], line[128];
	const char *positive = strchr(forms[form], '|');

	snprintf(one, sizeof(one), "%s", forms[form]);
	if (positive) /* defined for numbers above 0 */
		one[positive - forms[form]] = 'p';
	snprintf(line, sizeof(line), one, saturates ? "_SAT" : "",
	         form == 22 || form == 27 ? (mask ? ".x" : ".xy") : masks[mask]);
	snprintf(text, sizeof(text),
	         "ATTRIB a = fragment.texcoord[0]; ATTRIB b = fragment.texcoord[1]; TEMP r, p; MOV r, 0.25; ABS p, a; "
	         "ADD p, p, 0.1;\n%s\n"
	         "MAD result.color, r, 0.25, { 0.4, 0.5, 0.45, 0.5 };",
	         line);
	shade(text);
}

/* Each binding of state, and parameters in arrays and alone. */
static void binding(int i)
{
	static const char *const names[48] = {
		"fragment.color", "fragment.color.primary", "fragment.color.secondary", "fragment.texcoord",
		"fragment.texcoord[1].zxyw", "fragment.fogcoord", "state.material.ambient", "state.material.diffuse",
		"state.material.specular", "state.material.emission", "state.material.shininess", "state.material.back.diffuse",
		"state.light[0].ambient", "state.light[1].diffuse", "state.light[1].specular", "state.light[1].position",
		"state.light[1].attenuation", "state.light[1].spot.direction", "state.light[1].half", "state.lightmodel.ambient",
		"state.lightmodel.scenecolor", "state.lightmodel.back.scenecolor", "state.lightprod[1].ambient",
		"state.lightprod[1].front.diffuse", "state.lightprod[1].back.specular", "state.texenv.color",
		"state.texenv[1].color", "state.fog.color", "state.fog.params", "state.depth.range",
		"state.matrix.modelview.row[2]", "state.matrix.projection.row[0]", "state.matrix.mvp.row[1]",
		"state.matrix.mvp.transpose.row[3]", "state.matrix.modelview.inverse.row[2]",
		"state.matrix.projection.invtrans.row[2]", "state.matrix.texture[1].row[0]", "program.env[3]", "program.local[5]",
		"{ 0.3, 0.8 }", "0.6", "-fragment.color", "fragment.color.a", "fragment.color.primary.bgra", "array[1]", "array[2]",
		"other", "fragment.position",
	};
	char text[512];

	set_state();
	glProgramEnvParameter4fARB(GL_FRAGMENT_PROGRAM_ARB, 3, 0.1f, 0.9f, (float)i / 48, 0.5f);
	snprintf(text, sizeof(text),
	         "PARAM array[3] = { program.env[3], 0.7, { 0.2, 0.4, 0.6, 0.8 } };\nPARAM other = program.local[5]; # "
	         "a comment\n"
	         "OUTPUT o = result.color; ALIAS out = o;\nTEMP r; MOV r, %s; %s MAD out, r, 0.5, 0.25;",
	         names[i], strstr(names[i], "position") ? "MUL r, r, { 0.003, 0.004, 0.9, 0.3 };" : "");
	shade(text);
	glProgramLocalParameter4fvARB(GL_FRAGMENT_PROGRAM_ARB, 5, (const float[4]){ 0.7f, 0.2f, (float)i / 48, 0.5f });
}

/* Textures: kinds, computed coordinates, levels, projection. */
static void texture(int i)
{
	static const char *const texts[16] = {
		"TEX result.color, fragment.texcoord[0], texture[0], 2D;",
		"TXP result.color, fragment.texcoord[0], texture[0], 2D;",
		"TXB result.color, fragment.texcoord[0], texture[0], 2D;",
		"TEMP u, r; TEX u, fragment.texcoord[0], texture[0], 2D; TEX r, fragment.texcoord[0], texture[1], 2D; "
		"MAD result.color, u, 0.1, r;",
		"TEMP u, r; TEX u, fragment.texcoord[0], texture[0], 2D; TXP r, fragment.texcoord[0], texture[1], 2D; "
		"MAD result.color, u, 0.1, r;",
		"TEMP u, r; TEX u, fragment.texcoord[0], texture[0], 2D; TEX r, fragment.texcoord[0], texture[1], "
		"CUBE; MAD result.color, u, 0.1, r;",
		"TEMP u, r; TEX u, fragment.texcoord[0], texture[0], 2D; TEX r, fragment.texcoord[0], texture[1], 1D; "
		"MAD result.color, u, 0.1, r;",
		"TEMP u, r; TEX u, fragment.texcoord[0], texture[0], 2D; TEX r, fragment.texcoord[0], texture[1], 2D; "
		"MAD_SAT result.color, u, 0.1, r;",
		"TEMP c, r; MUL c, fragment.texcoord[0], 0.3; TEX r, c, texture[0], 2D; MUL result.color, r, "
		"fragment.color;",
		"TEMP c, r; TEX c, fragment.texcoord[1], texture[0], 2D; TEX r, c, texture[0], 2D; MOV result.color, "
		"r.zyxw;",
		"TEMP c, r; MUL c, fragment.texcoord[0], fragment.texcoord[0]; TEX_SAT result.color.xzw, c.yxzw, "
		"texture[0], 2D; MOV result.color.y, 0.5;",
		"TEMP a, b; TEX a, fragment.texcoord[0], texture[0], 2D; TEX b, fragment.texcoord[2], texture[1], 2D; "
		"LRP result.color, a.w, a, b;",
		"TEMP a; MOV a, fragment.texcoord[0]; MOV a.w, 2; TXB result.color, a, texture[0], 2D;",
		"TEMP a; MOV a, fragment.texcoord[0]; MOV a.w, -1; TXB result.color, a, texture[0], 2D;",
		"TEMP a; MUL a, fragment.color, { 3, 5, 1, 1 }; TEX result.color, a, texture[0], 2D;",
		"TEMP a; MUL a, fragment.position, 0.03; TEX result.color, a, texture[0], 2D;",
	};
	const int text = choose(&i, 16), matrix = choose(&i, 2), generated = choose(&i, 2);

	if (matrix) {
		glMatrixMode(GL_TEXTURE);
		glLoadIdentity();
		glScalef(1.5f, 0.7f, 1);
		glMatrixMode(GL_MODELVIEW);
	}
	if (generated) {
		glEnable(GL_TEXTURE_GEN_S);
		glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
	}
	shade(texts[text]);
}

static void draw_textured(int i)
{
	draw_square(i);
	glMatrixMode(GL_TEXTURE);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
}

/* Discarded fragments, written depth, fog options, lit and flat colours, points and lines, blending and tests after
 * the program. */
static void fragment(int i)
{
	static const char *const texts[8] = {
		"KIL fragment.texcoord[0]; MOV result.color, fragment.color;",
		"KIL -fragment.texcoord[0].x; MOV result.color, fragment.color.secondary;",
		"MOV result.color, fragment.color; MUL result.depth.z, fragment.color.x, 0.9;",
		"OPTION ARB_fog_linear; MOV result.color, fragment.color;",
		"OPTION ARB_fog_exp; MOV result.color, fragment.color;",
		"OPTION ARB_fog_exp2; OPTION ARB_precision_hint_fastest; MOV result.color, fragment.color;",
		"ADD result.color, fragment.color, fragment.color.secondary;",
		"SUB result.color, 1, fragment.color;",
	};
	const int text = choose(&i, 8), lit = choose(&i, 2), flat = choose(&i, 2), blend = choose(&i, 2),
		  by_coordinates = choose(&i, 2);

	glFogfv(GL_FOG_COLOR, (const float[4]){ 0.8f, 0.2f, 0.4f, 0.3f });
	glFogf(GL_FOG_START, 0.7f);
	glFogf(GL_FOG_END, 3.5f);
	glFogf(GL_FOG_DENSITY, 0.4f);
	glFogi(GL_FOG_COORD_SRC, by_coordinates ? GL_FOG_COORD : GL_FRAGMENT_DEPTH);
	glEnable(GL_DEPTH_TEST);
	glShadeModel(flat ? GL_FLAT : GL_SMOOTH);
	if (lit) {
		glEnable(GL_LIGHTING);
		glEnable(GL_LIGHT0);
		glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
		glEnable(GL_COLOR_MATERIAL);
	}
	if (blend) {
		glEnable(GL_BLEND);
		glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
		glEnable(GL_ALPHA_TEST);
		glAlphaFunc(GL_GREATER, 0.45f);
	}
	shade(texts[text]);
}

static void draw_fragments(int i)
{
	draw_square(i);
	glBegin(i / 8 % 2 ? GL_LINES : GL_TRIANGLES); /* geometry behind and in front */
	for (int k = 0; k < 6; k++) {
		glColor4f(0.9f, 0.15f * (float)k, 0.3f, 0.8f);
		glVertex3f(0.9f - 0.35f * (float)k, k % 2 ? -0.9f : 0.9f, 0.4f - 0.3f * (float)k);
	}
	glEnd();
}

/* Interpolation to the last bit: smooth and flat, whole and clipped behind the viewer, on both sides. */
static void last_bits(int i)
{
	static const char *const names[4] = { "fragment.color", "fragment.color.secondary", "fragment.fogcoord",
		                              "fragment.texcoord[1]" };
	const char *name = names[choose(&i, 4)];
	const int flat = choose(&i, 2), cut = choose(&i, 2), away = choose(&i, 2);
	char text[128];

	glFogi(GL_FOG_COORD_SRC, GL_FOG_COORD);
	glShadeModel(flat ? GL_FLAT : GL_SMOOTH);
	if (cut)
		glScalef(1, 1, -3);
	if (away)
		glScalef(-1, 1, 1);
	snprintf(text, sizeof(text), "TEMP r; MUL r, %s, 65536; MUL r, r, 4; FRC result.color, r;", name);
	shade(text);
}

int main(void)
{
	static const struct table tables[] = {
		{ 120, instruction, draw_square }, { 48, binding, draw_square }, { 64, texture, draw_textured },
		{ 128, fragment, draw_fragments }, { 32, last_bits, draw_square },
	};

	DRAW_TABLES(tables, make_images);
	return 0;
}
