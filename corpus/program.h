/*
 * What the corpus programs share: options, an 800x600 double-buffered window by GLUT, and a frame loop whose time is the
 * frame's number, so that every run draws the same pictures.
 *
 *   --frames N              exit after N frames (default: run until closed)
 *   --animate camera|light|none
 *   --vbo                   arrays from a buffer object where the program has arrays
 *   --mirror                make a mirror where the program has one to make
 */
#ifndef CORPUS_PROGRAM_H
#define CORPUS_PROGRAM_H

#define GL_GLEXT_PROTOTYPES
#include <GL/glut.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if __has_include("../capture/relume.h")
#include "../capture/relume.h"
#else
enum { RT_MATTE_EXT, RT_MIRROR_EXT, RT_GLASS_EXT };
#define rtMaterialEXT(material) ((void)(material))
#endif

enum { PROGRAM_WIDTH = 800, PROGRAM_HEIGHT = 600 };

struct program {
	const char *title;
	void (*draw)(void); /* one frame of `program_frame`, without the swap */
	long frames;        /* 0: no end */
	int animate_camera, animate_light, vbo, mirror;
};

static struct program program;
static long program_frame; /* from 0 */

static void program_display(void)
{
	program.draw();
	glFlush();
	glutSwapBuffers();
	if (++program_frame == program.frames)
		exit(0);
	glutPostRedisplay();
}

static void program_parse(int argc, char **argv)
{
	for (int i = 1; i < argc; i++) {
		const char *value = i + 1 < argc ? argv[i + 1] : "";

		if (strcmp(argv[i], "--frames") == 0 && atol(value) > 0) {
			program.frames = atol(value);
			i++;
		} else if (strcmp(argv[i], "--animate") == 0 && strcmp(value, "camera") == 0) {
			program.animate_camera = 1;
			i++;
		} else if (strcmp(argv[i], "--animate") == 0 && strcmp(value, "light") == 0) {
			program.animate_light = 1;
			i++;
		} else if (strcmp(argv[i], "--animate") == 0 && strcmp(value, "none") == 0) {
			i++;
		} else if (strcmp(argv[i], "--vbo") == 0) {
			program.vbo = 1;
		} else if (strcmp(argv[i], "--mirror") == 0) {
			program.mirror = 1;
		} else {
			fprintf(stderr, "usage: %s [--frames N] [--animate camera|light|none] [--vbo] [--mirror]\n",
			        argv[0]);
			exit(2);
		}
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
	glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH);
	glutInitWindowSize(PROGRAM_WIDTH, PROGRAM_HEIGHT);
	glutCreateWindow(title);
	init();
	glutDisplayFunc(program_display);
	glutMainLoop();
}

#endif
