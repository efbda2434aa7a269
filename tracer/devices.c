/* relume devices: what there is to render on. */
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/verbs.h"
#include "tracer/device/device.h"

static const char help[] =
	"usage: relume devices [--json]\n"
	"\n"
	"List the OpenCL devices: number, type, name, compute units and the floats that each computes with at once, memory,\n"
	"the family of traversal kernels that it runs (render --kernels names another), platform and driver. The number, the\n"
	"type (cpu, gpu, accelerator: the first of it) or any part of the name is what --device takes; without --device the\n"
	"first GPU is used, else the first device.\n"
	"'--device reference' runs the kernels' C twins: slow, needs no OpenCL.\n"
	"\n"
	"  --json   as JSON\n";

static void print_json_string(const char *text)
{
	putchar('"');
	for (; *text; text++) {
		if (*text == '"' || *text == '\\')
			putchar('\\');
		if ((unsigned char)*text >= 0x20)
			putchar(*text);
	}
	putchar('"');
}

static void print_json(const struct device_description *list, size_t n)
{
	puts("[");
	for (size_t i = 0; i < n; i++) {
		printf("  {\"number\": %zu, \"name\": ", i);
		print_json_string(list[i].name);
		fputs(", \"platform\": ", stdout);
		print_json_string(list[i].platform);
		fputs(", \"driver\": ", stdout);
		print_json_string(list[i].driver);
		printf(", \"type\": \"%s\", \"units\": %u, \"width\": %u, \"memory_bytes\": %llu, \"buffer_bytes\": %llu, "
		       "\"kernels\": \"%s\"}%s\n", device_type_name(list[i].type), list[i].units, list[i].width,
		       (unsigned long long)list[i].memory_bytes, (unsigned long long)list[i].buffer_bytes,
		       device_family_name(device_type_family(list[i].type)), i + 1 < n ? "," : "");
	}
	puts("]");
}

int devices_main(int argc, char **argv)
{
	static const struct option options[] = {
		{ "json", no_argument, NULL, 'j' }, { "help", no_argument, NULL, 'h' }, { NULL, 0, NULL, 0 }
	};
	struct device_description *list = NULL;
	size_t n;
	int json = 0, option, err;

	while ((option = getopt_long(argc, argv, "h", options, NULL)) != -1) {
		switch (option) {
		case 'j':
			json = 1;
			break;
		case 'h':
			fputs(help, stdout);
			return 0;
		default:
			return -ERR_USAGE;
		}
	}
	if (optind < argc)
		return -err_report(ERR_USAGE, NULL, "devices takes no argument '%s'", argv[optind]);
	err = device_list(&list, &n);
	if (err)
		return -err;
	if (json) {
		print_json(list, n);
	} else {
		for (size_t i = 0; i < n; i++)
			printf("%zu  %s  %s, %u units of width %u, %llu MiB, kernels: %s  (%s %s)\n", i,
			       device_type_name(list[i].type), list[i].name, list[i].units, list[i].width,
			       (unsigned long long)(list[i].memory_bytes >> 20),
			       device_family_name(device_type_family(list[i].type)), list[i].platform, list[i].driver);
	}
	free(list);
	return 0;
}
