/* A library that ci_viewer.c links; it decides which way the triangle faces. */
float shape_facing(void)
{
	return FACING;
}
