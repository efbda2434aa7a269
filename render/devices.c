/* relume devices: lists the devices that can render. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/options.h"
#include "base/verbs.h"
#include "tracer/device/device.h"

struct asked {
	int json;
};

static const struct options_row rows[] = {
	{ "json", 0, NULL, "as JSON", options_flag, .at = offsetof(struct asked, json) },
};

static const struct options_table table = {
	.verb = "devices",
	.head = "usage: relume devices [--json]\n"
	        "\n"
	        "List the OpenCL devices: number, type, name, compute units and the floats that each computes with at once, memory,\n"
	        "the family of traversal kernels that it runs (render --kernels names another), platform and driver. The number, the\n"
	        "type (cpu, gpu, accelerator: the first of it) or any part of the name is what --device takes; without --device the\n"
	        "first GPU is used, else the first device.\n"
	        "'--device reference' runs the kernels' C twins: slow, needs no OpenCL.\n",
	.rows = rows,
	.n_rows = sizeof(rows) / sizeof(rows[0]),
	.takes = "no arguments",
};

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
		       device_family_names[device_type_family(list[i].type)], i + 1 < n ? "," : "");
	}
	puts("]");
}

int devices_main(int argc, char **argv)
{
	struct asked o = { 0 };
	struct options_line line;
	struct device_description *list = NULL;
	size_t n;
	int err = options_parse(&table, argc, argv, &o, &line);

	if (err)
		return err > 0 ? 0 : -err;
	err = device_list(&list, &n);
	if (err)
		return -err;
	if (o.json) {
		print_json(list, n);
	} else {
		for (size_t i = 0; i < n; i++)
			printf("%zu  %s  %s, %u units of width %u, %llu MiB, kernels: %s  (%s %s)\n", i,
			       device_type_name(list[i].type), list[i].name, list[i].units, list[i].width,
			       (unsigned long long)(list[i].memory_bytes >> 20),
			       device_family_names[device_type_family(list[i].type)], list[i].platform, list[i].driver);
	}
	free(list);
	return 0;
}
