" `.sense` files are SenseDSL.
autocmd BufRead,BufNewFile *.sense setfiletype sensedsl
