/*
 * What the corpus programs share: options, an 800x600 double-buffered window by GLUT, and a frame loop. Its time is the
 * frame's number, so that every run draws the same pictures.
 *
 *   --frames N              exit after N frames (default: run until closed)
 *   --animate camera|light|none
 *   --step N                each frame is what the N-th from there would be (default: 1)
 *   --vbo                   arrays from a buffer object where the program has arrays
 *   --mirror                make a mirror where the program has one to make
 *   --glass                 add something of glass where the program has it
 *   --mesh                  add the model where the program can do without
 *   --model FILE            an OBJ file where the program shows a model (default: a generated knot)
 *   --size WxH              of the window (default: 800x600)
 *   --ortho                 parallel projection where the program has a choice
 *   --by HOW                by which way, where the program has several
 */
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glut.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if __has_include("../capture/relume.h") && !defined(_WIN32)
#include "../capture/relume.h"
#else
enum { RT_MATTE_EXT, RT_MIRROR_EXT, RT_GLASS_EXT };
#define rtMaterialEXT(kind, amount, ior) ((void)(kind), (void)(amount), (void)(ior))
#endif

struct program {
	const char *title;
	void (*draw)(void); /* one frame of `program_frame`, without the swap */
	long frames;        /* 0: no end */
	long step;          /* frames of time from one to the next */
	int width, height;  /* of the window */
	int animate_camera, animate_light, vbo, mirror, glass, mesh, ortho;
	int stencil;        /* set before program_run: the window has a stencil buffer */
	const char *model, *by; /* NULL: none given */
};

static struct program program = { .step = 1, .width = 800, .height = 600 };
#define PROGRAM_WIDTH program.width
#define PROGRAM_HEIGHT program.height
static long program_frame; /* from 0, in steps */

static void program_display(void)
{
	program.draw();
	glFlush();
	glutSwapBuffers();
	program_frame += program.step;
	if (program.frames && program_frame >= program.frames * program.step)
		exit(0);
	glutPostRedisplay();
}

static void program_usage(const char *name)
{
	fprintf(stderr, "usage: %s [--frames N] [--step N] [--animate camera|light|none] [--vbo] [--mirror] [--glass] "
	        "[--mesh] [--size WxH] [--ortho] [--model FILE] [--by HOW]\n", name);
	exit(2);
}

static void program_animate(const char *name, const char *what)
{
	program.animate_camera = strcmp(what, "camera") == 0;
	program.animate_light = strcmp(what, "light") == 0;
	if (!program.animate_camera && !program.animate_light && strcmp(what, "none") != 0)
		program_usage(name);
}

static void program_parse(int argc, char **argv)
{
	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--vbo") == 0)
			program.vbo = 1;
		else if (strcmp(argv[i], "--mirror") == 0)
			program.mirror = 1;
		else if (strcmp(argv[i], "--glass") == 0)
			program.glass = 1;
		else if (strcmp(argv[i], "--mesh") == 0)
			program.mesh = 1;
		else if (strcmp(argv[i], "--ortho") == 0)
			program.ortho = 1;
		else if (i + 1 == argc)
			program_usage(argv[0]);
		else if (strcmp(argv[i], "--frames") == 0 && atol(argv[i + 1]) > 0)
			program.frames = atol(argv[++i]);
		else if (strcmp(argv[i], "--step") == 0 && atol(argv[i + 1]) > 0)
			program.step = atol(argv[++i]);
		else if (strcmp(argv[i], "--size") == 0 && sscanf(argv[i + 1], "%dx%d", &program.width, &program.height) == 2)
			i++;
		else if (strcmp(argv[i], "--animate") == 0)
			program_animate(argv[0], argv[++i]);
		else if (strcmp(argv[i], "--model") == 0)
			program.model = argv[++i];
		else if (strcmp(argv[i], "--by") == 0)
			program.by = argv[++i];
		else
			program_usage(argv[0]);
	}
}

/**
 * Open the window and draw frames until the last one; does not return.
 * @param init  called once with the context current, before the first frame
 */
static void program_run(int argc, char **argv, const char *title, void (*init)(void), void (*draw)(void))
{
	glutInit(&argc, argv);
	program.title = title;
	program.draw = draw;
	program_parse(argc, argv);
	glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH | (program.stencil ? GLUT_STENCIL : 0));
	glutInitWindowSize(PROGRAM_WIDTH, PROGRAM_HEIGHT);
	glutCreateWindow(title);
	init();
	glutDisplayFunc(program_display);
	glutMainLoop();
}

/** A perspective projection that suits the window; the modelview matrix is current afterwards. */
static inline void program_perspective(double fovy_deg, double near, double far)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	gluPerspective(fovy_deg, (double)PROGRAM_WIDTH / PROGRAM_HEIGHT, near, far);
	glMatrixMode(GL_MODELVIEW);
}

/** The ambient and diffuse colour of both sides of what is drawn next. */
static inline void program_color(float red, float green, float blue)
{
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, (const float[]){ red, green, blue, 1 });
}

/** How far something has moved by this frame, at so much a frame; 0 where it stands still. */
static inline float program_moved(int is_animated, float a_frame)
{
	return is_animated ? a_frame * (float)program_frame : 0;
}
