#include <app/shell.h>
