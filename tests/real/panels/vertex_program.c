/*
 * ARB_vertex_program: each instruction, binding and result, address registers, attributes by calls, arrays and lists,
 * with fragment programs and with fixed function, on a tilted sheet. Finally, NaN and infinity.
 */
#include "programs.h"

#define PLACED "DP4 result.position.x, m[0], vertex.position; DP4 result.position.y, m[1], vertex.position;\n" \
	"DP4 result.position.z, m[2], vertex.position; DP4 result.position.w, m[3], vertex.position;\n"

static GLuint image, buffers[2];

static void prepare(void)
{
	unsigned char texels[16 * 16 * 4];

	fill(texels, sizeof(texels), 3);
	glGenTextures(1, &image);
	glBindTexture(GL_TEXTURE_2D, image);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glBindTexture(GL_TEXTURE_2D, 0);
	glGenBuffers(2, buffers);
}

/* Use a vertex program that transforms positions by the matrices and computes the rest by the text. */
static void transform(const char *text)
{
	char whole[4096];

	snprintf(whole, sizeof(whole), "PARAM m[4] = { state.matrix.mvp };\n%s\n%s", PLACED, text);
	set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0", whole);
}

enum { CELLS = 5 };

/* A vertex of the sheet; by_number: using numbered attributes. */
static void put_vertex(int x, int y, int by_number)
{
	const float u = (float)x / CELLS, v = (float)y / CELLS;

	set_corner(u, v);
	if (by_number) {
		glVertexAttrib4f(9, 0.9f * u, 1 - v, u * v, 1);
		glVertexAttrib2f(14, 5 * u, 4 * v);
		glVertexAttrib4Nub(15, (GLubyte)(40 * x), (GLubyte)(250 - 30 * y), 77, 200);
	}
	glVertex3f(2 * u - 1, 2 * v - 1, -v);
}

static void put_sheet(int by_number)
{
	for (int y = 0; y < CELLS; y++) {
		glBegin(GL_TRIANGLE_STRIP);
		for (int x = 0; x <= CELLS; x++) {
			put_vertex(x, y, by_number);
			put_vertex(x, y + 1, by_number);
		}
		glEnd();
	}
}

static void draw_sheet(int i)
{
	(void)i;
	put_sheet(1);
}

/* Each instruction, with inputs below 0 and above 1; written to all components, to two, and to the position. */
static void instruction(int i)
{
	static const char *const forms[32] = {
		"ABS r%s, a;",        "ADD r%s, a, b;",
		"DP3 r%s, a, b;",     "DP4 r%s, a, b;",
		"DPH r%s, a, b;",     "DST r%s, a, b;",
		"EX2 r%s, a.y;",      "EXP r%s, a.x;",
		"FLR r%s, a;",        "FRC r%s, a;",
		"LG2 r%s, p.x;",      "LIT r%s, a;",
		"LOG r%s, a.y;",      "MAD r%s, a, b, a.wzyx;",
		"MAX r%s, a, b;",     "MIN r%s, a, b;",
		"MOV r%s, a.yxwz;",   "MUL r%s, a, -b;",
		"POW r%s, p.x, b.y;", "RCP r%s, a.w;",
		"RSQ r%s, p.y;",      "SGE r%s, a, b;",
		"SLT r%s, a, b;",     "SUB r%s, a, b;",
		"XPD r%s, a, b;",     "SWZ r%s, a, -y, 1, 0, x;",
		"MOV r%s, -a.z;",     "EXP r%s, p.z;",
		"LOG r%s, p.w;",      "ARL A.x, a.y; MOV r%s, steps[A.x + 2];",
		"RSQ r%s, -p.x;",     "LIT r%s, p.zyxw;",
	};
	static const char *const uses[4] = {
		"MAD result.color, r, 0.25, { 0.4, 0.5, 0.45, 0.5 };",
		"MAD result.color, r, 0.25, { 0.4, 0.5, 0.45, 0.5 };",
		"MOV result.color, vertex.color; MUL r, r, 0.05; ADD r.xyz, r, vertex.position; MOV r.w, 1;\n"
		"DP4 result.position.x, m[0], r; DP4 result.position.y, m[1], r; DP4 result.position.z, m[2], r; DP4 "
		"result.position.w, m[3], r;",
		"MOV result.color, vertex.color; MUL result.texcoord[0].xyz, r, 0.3; MOV result.texcoord[0].w, r.x; "
		"ADD result.texcoord[0].w, p.x, 1;",
	};
	const int form = choose(&i, 32), use = choose(&i, 4);
	char text[2048], line[256];

	snprintf(line, sizeof(line), forms[form], use != 1 ? "" : form == 24 ? ".x" : ".xz");
	snprintf(text, sizeof(text),
	         "ATTRIB a = vertex.texcoord[0]; ATTRIB b = vertex.texcoord[1]; TEMP r, p; ADDRESS A;\n"
	         "PARAM steps[5] = { { 0.1, 1, 0.3, 1 }, { 0.9, 0.2, 0.4, 1 }, { 0.5, 0.7, 1, 0.6 }, { 0, 0.3, 0.8, "
	         "0.9 }, 0.4 };\n"
	         "MOV r, 0.25; ABS p, a; ADD p, p, 0.1;\n%s\n%s",
	         line, uses[use]);
	transform(text);
	if (use == 3) {
		glBindTexture(GL_TEXTURE_2D, image);
		glEnable(GL_TEXTURE_2D);
	}
}

static void load_own_matrices(void)
{
	for (unsigned k = 0; k < 3; k++) {
		glMatrixMode(GL_MATRIX0_ARB + k);
		glLoadIdentity();
		glRotatef(20.0f * (float)k, 0.3f, 0.5f, 1);
		glScalef(0.7f, 1 + 0.1f * (float)k, 0.5f);
	}
	glMatrixMode(GL_MODELVIEW);
}

/* Each binding of attributes, state and parameters, in arrays and alone. */
static void binding(int i)
{
	static const char *const names[80] = {
		"vertex.position", "vertex.normal", "vertex.color", "vertex.color.primary", "vertex.color.secondary",
		"vertex.fogcoord", "vertex.texcoord", "vertex.texcoord[1].zxyw", "vertex.texcoord[5]", "vertex.attrib[9]",
		"vertex.attrib[14]", "vertex.attrib[15]", "vertex.attrib[12]", "vertex.attrib[7]", "-vertex.color",
		"vertex.color.w", "vertex.color.primary.zyxw", "{ 0.3, 0.8 }", "0.6", "{ 0.7 }.x", "program.env[3]",
		"program.local[5]", "array[1]", "array[2]", "other", "state.material.ambient", "state.material.diffuse",
		"state.material.specular", "state.material.emission", "state.material.shininess", "state.material.back.diffuse",
		"state.material.front.specular", "state.light[0].ambient", "state.light[1].diffuse", "state.light[1].specular",
		"state.light[1].position", "state.light[1].attenuation", "state.light[1].spot.direction", "state.light[1].half",
		"state.lightmodel.ambient", "state.lightmodel.scenecolor", "state.lightmodel.front.scenecolor",
		"state.lightmodel.back.scenecolor", "state.lightprod[1].ambient", "state.lightprod[1].front.diffuse",
		"state.lightprod[1].back.specular", "state.fog.color", "state.fog.params", "state.clip[1].plane",
		"state.point.size", "state.point.attenuation", "state.texgen[1].eye.s", "state.texgen[1].eye.q",
		"state.texgen[0].object.t", "state.texgen.object.r", "state.matrix.modelview.row[2]",
		"state.matrix.modelview[0].row[1]", "state.matrix.projection.row[0]", "state.matrix.mvp.row[1]",
		"state.matrix.mvp.transpose.row[3]", "state.matrix.modelview.inverse.row[2]",
		"state.matrix.projection.invtrans.row[2]", "state.matrix.mvp.inverse.row[3]", "state.matrix.texture[1].row[0]",
		"state.matrix.texture.row[1]", "state.matrix.program[1].row[0]", "state.matrix.program[2].inverse.row[1]",
		"state.matrix.program[0].invtrans.row[2]", "state.matrix.program[7].row[0]", "rows[0]", "rows[2]", "rows[3]",
		"some[0]", "some[1]", "locals[2]", "locals[6]", "vertex.normal.zzxy", "program.env[95]", "program.local[77].wzyx",
		"program.env[4].y",
	};
	char text[2048];

	set_state();
	load_own_matrices();
	glProgramEnvParameter4fARB(GL_VERTEX_PROGRAM_ARB, 3, 0.1f, 0.9f, (float)i / 80, 0.5f);
	glProgramEnvParameter4dARB(GL_VERTEX_PROGRAM_ARB, 4, 0.8, 0.3, 0.2, 1);
	glProgramEnvParameter4fvARB(GL_VERTEX_PROGRAM_ARB, 95, (const float[4]){ 0.2f, 0.5f, 0.9f, 0.4f });
	glMultiTexCoord4f(GL_TEXTURE5, 0.3f, 0.9f, 0.1f, 0.7f);
	glVertexAttrib3f(12, 0.8f, 0.6f, 0.1f);
	snprintf(text, sizeof(text),
	         "PARAM array[3] = { program.env[3], 0.7, { 0.2, 0.4, 0.6, 0.8 } };\nPARAM other = program.local[5]; # "
	         "a comment\n"
	         "PARAM rows[] = { state.matrix.program[1].transpose }; PARAM some[2] = { "
	         "state.matrix.program[2].row[1..2] };\n"
	         "PARAM locals[8] = { program.local[3..10] };\n"
	         "OUTPUT o = result.color; ALIAS out = o;\nTEMP r; MOV r, %s; MAD out, r, 0.5, 0.25;",
	         names[i]);
	transform(text);
	for (unsigned k = 3; k < 11; k++)
		glProgramLocalParameter4fvARB(GL_VERTEX_PROGRAM_ARB, k,
		                              (const float[4]){ 0.7f, 0.1f * (float)k, (float)i / 80, 0.5f });
	glProgramLocalParameter4fARB(GL_VERTEX_PROGRAM_ARB, 77, 0.2f, 0.4f, 0.6f, 0.8f);
}

/*
 * Address registers: an attribute selects the bone that moves a vertex; positive and negative offsets; elements out of
 * range.
 */
static void address(int i)
{
	static const char *const texts[8] = {
		"ARL A.x, w.x; MUL r, bones[A.x], vertex.position.y; ADD r, r, vertex.position;",
		"ARL A.x, w.y; ADD r, vertex.position, bones[A.x + 2];",
		"ARL A.x, w.x; MAD r, bones[A.x + 3], { 0.5, 0.5, 0.5, 0 }, vertex.position;",
		"ARL A.x, w.x; MUL r, bones[A.x], 0.6; ARL A.x, w.y; MAD r, bones[A.x], 0.4, r; ADD r, r, "
		"vertex.position; MOV r.w, 1;",
		"ARL A.x, w.x; ADD r, bones[A.x], -bones[A.x + 1]; ADD r.xyz, r, vertex.position; MOV r.w, 1;",
		"ARL A.x, w.x; MAD r, bones[A.x].yxzw, bones[A.x + 1].xyxw, vertex.position; MOV r.w, 1;",
		"MUL r, w, 0.99; ARL A.x, -r.x; ADD r, vertex.position, bones[A.x + 5];",
		"ARL A.x, w.x; MOV r, vertex.position; MAD r.xy, bones[A.x].w, { 0.1, 0.2, 0, 0 }, r;",
	};
	const int text = choose(&i, 8), smooth = choose(&i, 2);
	char whole[1024];

	snprintf(whole, sizeof(whole),
	         "PARAM m[4] = { state.matrix.mvp }; PARAM bones[9] = { program.env[20..28] }; ADDRESS A; TEMP r, w;\n"
	         "%s w, vertex.attrib[14]; MIN w, w, { 5, 4, 3, 3 };\n%s\n"
	         "DP4 result.position.x, m[0], r; DP4 result.position.y, m[1], r; DP4 result.position.z, m[2], r; DP4 "
	         "result.position.w, m[3], r;\n"
	         "MAD result.color, r, 0.4, { 0.5, 0.4, 0.6, 1 };",
	         smooth ? "MOV" : "FLR", texts[text]);
	set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0", whole);
	for (unsigned k = 0; k < 9; k++)
		glProgramEnvParameter4fARB(GL_VERTEX_PROGRAM_ARB, 20 + k, 0.5f * noise(3 * k) - 0.25f,
		                           0.5f * noise(3 * k + 1) - 0.25f, 0.4f * noise(3 * k + 2), 0);
}

/* Results: two-sided and secondary colours, fog, texture coordinates, point sizes; clip planes, culling; each kind
 * of fragment stage. */
static void result(int i)
{
	static const char *const texts[8] = {
		"MOV result.color, vertex.color; MOV result.color.back, { 0.9, 0.1, 0.2, 1 };",
		"MOV result.color, vertex.color; MOV result.color.secondary, vertex.color.secondary; MOV "
		"result.color.back.primary, vertex.color.zyxw; "
		"MOV result.color.back.secondary, { 0.1, 0.3, 0, 0 };",
		"MOV result.color, vertex.color; MUL result.fogcoord.x, vertex.fogcoord.x, 0.7;",
		"MOV result.color, vertex.color; MOV result.texcoord, vertex.texcoord; MOV result.texcoord[1], "
		"vertex.texcoord[1];",
		"MUL result.color, vertex.color, 1.7; MUL result.texcoord[0], vertex.texcoord[0].yxzw, { 1, 0.4, 1, "
		"0.8 }; MOV result.texcoord[1], vertex.attrib[9];",
		"MOV result.color, vertex.color; MAD result.pointsize.x, vertex.attrib[14].x, 1.3, 0.4; MOV "
		"result.texcoord[0], vertex.attrib[9];",
		"MOV result.color.front, vertex.attrib[15]; MOV result.texcoord[0].xy, vertex.texcoord[0]; MOV "
		"result.texcoord[0].zw, { 0, 0, 0, 1 };",
		"MOV result.color.front.primary, vertex.normal; ADD result.color.front.secondary, vertex.color, -0.5; "
		"MOV result.fogcoord, vertex.position.y;",
	};
	const int text = choose(&i, 8), stage = choose(&i, 3), invariant = choose(&i, 2), way = choose(&i, 4);
	char whole[2048];

	glFogfv(GL_FOG_COLOR, (const float[4]){ 0.8f, 0.2f, 0.4f, 0.3f });
	glFogi(GL_FOG_MODE, GL_LINEAR);
	glFogf(GL_FOG_END, 3);
	snprintf(whole, sizeof(whole), "%s%s%s",
	         invariant ? "OPTION ARB_position_invariant;" : "PARAM m[4] = { state.matrix.mvp };\n",
	         invariant ? "" : PLACED, texts[text]);
	set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0", whole);
	if (way == 1)
		glEnable(GL_VERTEX_PROGRAM_TWO_SIDE);
	else
		glDisable(GL_VERTEX_PROGRAM_TWO_SIDE);
	glFrontFace(way == 1 ? GL_CW : GL_CCW);
	if (way == 2) {
		glEnable(GL_CLIP_PLANE0);
		glClipPlane(GL_CLIP_PLANE0, (const double[4]){ 0.5, 1, 0, 0.1 });
	}
	if (way == 3) {
		glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
		glEnable(GL_VERTEX_PROGRAM_POINT_SIZE);
	} else {
		glDisable(GL_VERTEX_PROGRAM_POINT_SIZE);
	}
	glBindTexture(GL_TEXTURE_2D, image);
	if (stage == 0 && text >= 2) {
		if (text == 2 || text == 7)
			glEnable(GL_FOG);
		else
			glEnable(GL_TEXTURE_2D);
	} else if (stage == 0) {
		glEnable(GL_COLOR_SUM);
	}
	if (stage == 1)
		set_program(GL_FRAGMENT_PROGRAM_ARB, "!!ARBfp1.0",
		            text == 3 ? "MAD result.color, fragment.texcoord[0], 0.3, fragment.texcoord[1];" :
		            text == 2 || text == 7 ? "MUL result.color, fragment.color, fragment.fogcoord.x;" :
		            text < 2 ? "ADD result.color, fragment.color, fragment.color.secondary;" :
		            "TEMP t; TEX t, fragment.texcoord[0], texture[0], 2D; MUL result.color, t, fragment.color;");
}

/* A panel must not leave its own context state to the next one. */
static void draw_result(int i)
{
	put_sheet(1);
	(void)i;
	glDisable(GL_VERTEX_PROGRAM_TWO_SIDE);
	glDisable(GL_VERTEX_PROGRAM_POINT_SIZE);
}

/* --- Ways of giving attributes ----------------------------------------------------------------------------------- */

static void attribute(int i)
{
	const int text = choose(&i, 2), numbered = choose(&i, 2);

	if (numbered) { /* by its number alone */
		set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0",
		            "PARAM m[4] = { state.matrix.mvp }; ATTRIB p = vertex.attrib[0]; DP4 result.position.x, "
		            "m[0], p; DP4 result.position.y, m[1], p;\n"
		            "DP4 result.position.z, m[2], p; DP4 result.position.w, m[3], p; MOV result.color, "
		            "vertex.attrib[15];");
		return;
	}
	transform(text ? "MAD result.color, vertex.attrib[9], { 1, 0.5, 1, 1 }, vertex.attrib[15]; MOV "
	                 "result.texcoord[0], vertex.attrib[14];" :
	                 "MOV result.color, vertex.attrib[15];");
}

struct corner {
	float place[3], nine[4];
	unsigned char fifteen[4];
	short fourteen[2];
};

static struct corner corners[4 * CELLS * CELLS];

static void fill_corners(void)
{
	for (int k = 0; k < 4 * CELLS * CELLS; k++) {
		const int cell = k / 4, x = cell % CELLS + (k % 4 == 1 || k % 4 == 2), y = cell / CELLS + k % 4 / 2;
		const float u = (float)x / CELLS, v = (float)y / CELLS;

		corners[k] = (struct corner){ { 2 * u - 1, 2 * v - 1, -v },
			                      { 0.9f * u, 1 - v, u * v, 1 },
			                      { (unsigned char)(40 * x), (unsigned char)(250 - 30 * y), 77, 200 },
			                      { (short)(5 * x), (short)(-3 * y) } };
	}
}

/* Place arrays in client memory or in a buffer. */
static const char *place_arrays(int in_buffer)
{
	fill_corners();
	if (!in_buffer)
		return (const char *)corners;
	glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
	glBufferData(GL_ARRAY_BUFFER, sizeof(corners), corners, GL_STATIC_DRAW);
	return NULL;
}

static void draw_arrays(int i)
{
	const int in_buffer = i / 2 % 2, numbered = i / 4 % 2, by_elements = i / 8 % 2;
	const char *from = place_arrays(in_buffer);
	unsigned short elements[4 * CELLS * CELLS];

	for (unsigned k = 0; k < 4 * CELLS * CELLS; k++)
		elements[k] = (unsigned short)(4 * CELLS * CELLS - 1 - k);
	if (numbered) {
		glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(corners[0]), from);
		glEnableVertexAttribArray(0);
	} else {
		glVertexPointer(3, GL_FLOAT, sizeof(corners[0]), from);
		glEnableClientState(GL_VERTEX_ARRAY);
	}
	glVertexAttribPointer(9, 4, GL_FLOAT, GL_FALSE, sizeof(corners[0]), from + 12);
	glVertexAttribPointer(15, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(corners[0]), from + 28);
	glVertexAttribPointer(14, 2, GL_SHORT, GL_FALSE, sizeof(corners[0]), from + 32);
	glEnableVertexAttribArray(9);
	glEnableVertexAttribArray(15);
	glEnableVertexAttribArray(14);
	if (by_elements)
		glDrawElements(GL_QUADS, 4 * CELLS * CELLS, GL_UNSIGNED_SHORT, elements);
	else
		glDrawArrays(GL_QUADS, 0, 4 * CELLS * CELLS);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
	glDisableClientState(GL_VERTEX_ARRAY);
	for (unsigned k = 0; k < 16; k++)
		glDisableVertexAttribArray(k);
}

static void draw_list(int i)
{
	const GLuint list = glGenLists(1);

	glNewList(list, i / 2 % 2 ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
	glVertexAttrib4f(15, 0.3f, 0.9f, 0.5f, 1);
	put_sheet(1);
	glEndList();
	if (i / 2 % 2)
		glCallList(list);
}

static void draw_ways(int i)
{
	if (i < 16)
		draw_arrays(i);
	else if (i < 20)
		draw_list(i);
	else
		put_sheet(1);
}

/*
 * --- Typical uses of programs --------------------------------------------------------------------------------------
 */

/* Per-vertex lighting, cartoon shading by a table, waves, skinning by two bones, blending of two shapes, reflection
 * maps; with fixed function beside them. */
static void scene(int i)
{
	static const char *const texts[8] = {
		"TEMP n, l, d; DP3 n.x, state.matrix.modelview.invtrans.row[0], vertex.normal; DP3 n.y, "
		"state.matrix.modelview.invtrans.row[1], vertex.normal;\n"
		"DP3 n.z, state.matrix.modelview.invtrans.row[2], vertex.normal; DP3 d.w, n, n; RSQ d.w, d.w; MUL "
		"n.xyz, n, d.w;\n"
		"DP3 d.x, n, state.light[0].half; DP3 d.y, n, state.light[0].half; MOV d.w, 20; LIT l, d; MAD d, "
		"state.lightprod[0].diffuse, l.y, state.lightmodel.scenecolor;\n"
		"MAD result.color.xyz, state.lightprod[0].specular, l.z, d; MOV result.color.w, d.w;",
		"TEMP d; ADDRESS A; PARAM tone[4] = { { 0.2, 0.1, 0.3, 1 }, { 0.5, 0.3, 0.4, 1 }, { 0.8, 0.6, 0.5, 1 "
		"}, { 1, 0.95, 0.8, 1 } };\n"
		"DP3 d.x, vertex.normal, { 0.5, 0.6, 0.8, 0 }; MUL d.x, d.x, 2.9; MAX d.x, d.x, 0; ARL A.x, d.x; MOV "
		"result.color, tone[A.x];",
		"TEMP p; PARAM w = { 6.28, 3.1, 0.2, 1 }; MOV p, vertex.position; MUL p.w, p.x, w.y; FRC p.w, p.w; MAD "
		"p.w, p.w, 2, -1; MUL p.w, p.w, p.w; MAD p.z, p.w, w.z, p.z;\n"
		"MOV p.w, 1; DP4 result.position.x, m[0], p; DP4 result.position.y, m[1], p; DP4 result.position.z, "
		"m[2], p; DP4 result.position.w, m[3], p;\n"
		"MOV result.color, vertex.color;",
		"TEMP a, b; PARAM one[4] = { state.matrix.program[0] }; PARAM two[4] = { state.matrix.program[1] }; "
		"DP4 a.x, one[0], vertex.position;\n"
		"DP4 a.y, one[1], vertex.position; DP4 a.z, one[2], vertex.position; DP4 b.x, two[0], vertex.position; "
		"DP4 b.y, two[1], vertex.position;\n"
		"DP4 b.z, two[2], vertex.position; SUB b, b, a; MAD a.xyz, b, vertex.attrib[9].y, a; MOV a.w, 1; DP4 "
		"result.position.x, m[0], a;\n"
		"DP4 result.position.y, m[1], a; DP4 result.position.z, m[2], a; DP4 result.position.w, m[3], a; MOV "
		"result.color, vertex.attrib[15];",
		"TEMP e, r, k; DP4 e.x, state.matrix.modelview.row[0], vertex.position; DP4 e.y, "
		"state.matrix.modelview.row[1], vertex.position;\n"
		"DP4 e.z, state.matrix.modelview.row[2], vertex.position; DP3 e.w, e, e; RSQ e.w, e.w; MUL e.xyz, e, "
		"e.w; DP3 k.x, e, vertex.normal; MUL k.x, k.x, 2;\n"
		"MAD r, -k.x, vertex.normal, e; MAD result.texcoord[0].xy, r, 0.5, 0.5; MOV result.texcoord[0].zw, { "
		"0, 0, 0, 1 }; MOV result.color, 1;",
		"MOV result.color, vertex.color; MUL result.fogcoord.x, vertex.position.y, 1.5;",
		"MOV result.color, vertex.color;",
		"TEMP p; MUL p, vertex.position, { 1.4, 1.4, 1, 1 }; DP4 result.position.x, m[0], p; DP4 "
		"result.position.y, m[1], p; MOV result.position.z, 0.2;\n"
		"DP4 result.position.w, m[3], p; MOV result.color, vertex.color;",
	};
	const int text = choose(&i, 8), depth = choose(&i, 2);

	glLightfv(GL_LIGHT0, GL_POSITION, (const float[4]){ 0.2f, 0.3f, 1, 0 });
	load_own_matrices();
	transform(texts[text]);
	if (text == 4) {
		glBindTexture(GL_TEXTURE_2D, image);
		glEnable(GL_TEXTURE_2D);
	}
	if (text == 5)
		glEnable(GL_FOG);
	if (depth)
		glEnable(GL_DEPTH_TEST);
	if (text == 6)
		glFrustum(-0.1, 0.1, -0.1, 0.1, 1, 4);
}

static void draw_scene(int i)
{
	put_sheet(1);
	glDisable(GL_VERTEX_PROGRAM_ARB);
	glDisable(GL_FOG);
	glBegin(GL_TRIANGLES); /* geometry behind and in front, by fixed function */
	for (int k = 0; k < 6; k++) {
		glColor4f(0.9f, 0.15f * (float)k, 0.3f, 0.8f);
		glVertex3f(0.9f - 0.35f * (float)k, k % 2 ? -0.9f : 0.9f, 0.4f - 0.3f * (float)k);
	}
	glEnd();
	(void)i;
}

/*
 * --- NaN and infinity ----------------------------------------------------------------------------------------------
 */

/* Positions, colours and sizes that are infinite, NaN or too large, also behind the viewer, with and without
 * matrices; filled and as points. */
static void extreme(int i)
{
	static const char *const texts[7] = {
		"RCP a.x, zero.x; MUL result.position, vertex.position, a.x; MOV result.color, a.x;",
		"RCP a.x, zero.x; SUB a.y, a.x, a.x; MOV result.position, a.y; MOV result.color, a.y;",
		"MUL a, vertex.position, big; MUL result.position, a, big; MOV result.color, a;",
		"ARL A.x, big.x; MOV result.position, none[A.x + 3]; MOV result.color, vertex.color;",
		"MOV result.position, vertex.position; MOV result.position.w, zero; MOV result.color, big; MOV "
		"result.fogcoord, big;",
		"MOV result.position, -vertex.position; MOV result.position.w, -big; MOV result.color, -big;",
		"LG2 a.x, zero.x; EX2 a.y, big.x; MUL result.position, a.x, a.y; RCP result.color, zero.x; MOV "
		"result.pointsize.x, big.x;",
	};
	const int text = choose(&i, 7), own = choose(&i, 2), points = choose(&i, 2), flat = choose(&i, 2);
	char whole[1024];

	glMatrixMode(GL_PROJECTION);
	if (own)
		glLoadIdentity();
	if (flat)
		glScalef(0, 0, 0);
	glMatrixMode(GL_MODELVIEW);
	if (points) {
		glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
		glEnable(GL_VERTEX_PROGRAM_POINT_SIZE);
	}
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CLIP_PLANE0);
	snprintf(whole, sizeof(whole),
	         "PARAM zero = { 0, 0, 0, 0 }; PARAM big = { 3e38, 3e38, 3e38, 3e38 }; PARAM none[5] = { "
	         "program.env[60..64] }; ADDRESS A; TEMP a;\n"
	         "MOV a, zero;\n%s",
	         texts[text]);
	set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0", whole);
}

int main(void)
{
	static const struct table tables[] = {
		{ 128, instruction, draw_sheet }, { 80, binding, draw_sheet }, { 16, address, draw_sheet },
		{ 192, result, draw_result }, { 24, attribute, draw_ways }, { 16, scene, draw_scene }, { 56, extreme, draw_result },
	};

	DRAW_TABLES(tables, prepare);
	return 0;
}
