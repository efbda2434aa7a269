/*
 * The verbs of the command: one function each, defined in the stage that does the work.
 *
 * Each takes argc and argv with argv[0] the verb's name and argv[argc] NULL (as getopt_long expects), prints its own
 * --help, and returns the exit code: 0 done and passed, 1 compared and failed, 2 wrong usage, 3 input unreadable,
 * 4 baseline new or missing, 5 a device or the system failed.
 */
#pragma once

int record_main(int argc, char **argv);  /* capture/record.c */
int info_main(int argc, char **argv);    /* verbs/recording/info.c */
int index_main(int argc, char **argv);   /* verbs/recording/index.c */
int dump_main(int argc, char **argv);    /* verbs/recording/dump.c */
int scene_main(int argc, char **argv);   /* verbs/recording/scene.c */
int trim_main(int argc, char **argv);    /* verbs/recording/trim.c */
int repair_main(int argc, char **argv);  /* verbs/recording/repair.c */
int bisect_main(int argc, char **argv);  /* verbs/bisect/bisect.c */
int export_main(int argc, char **argv);  /* verbs/recording/export.c */
int look_main(int argc, char **argv);    /* verbs/render/look.c */
int render_main(int argc, char **argv);  /* verbs/render/render.c */
int hook_main(int argc, char **argv);    /* verbs/render/hook.c */
int query_main(int argc, char **argv);   /* verbs/query/query.c */
int pick_main(int argc, char **argv);    /* verbs/render/pick.c */
int ci_main(int argc, char **argv);      /* ci/ci.c */
int farm_main(int argc, char **argv);    /* verbs/farm/farm.c */
int devices_main(int argc, char **argv); /* verbs/render/devices.c */
int bench_main(int argc, char **argv);   /* verbs/render/bench/bench.c */
int raster_main(int argc, char **argv);  /* verbs/recording/raster.c */
int film_main(int argc, char **argv);    /* verbs/film/film.c */
int denoise_main(int argc, char **argv); /* verbs/film/denoise.c */
int approve_main(int argc, char **argv); /* diff/baseline/approve.c */
/* relume diff and reduce get functions of stages that they must not include: diff/diff.h, verbs/recording/reduce.h. */
