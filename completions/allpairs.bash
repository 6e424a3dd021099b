# Completion of the command allpairs for bash.

_allpairs() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local command=${COMP_WORDS[1]} words=''
  COMPREPLY=()
  case $previous in
    --strategy) words='auto exhaustive blocked' ;;
    --format) words='table csv json npy' ;;
    --data)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$current")
      return
      ;;
    --margin | --box | --threads) return ;;
  esac
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    return
  fi
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W 'detect info --help -h --version' -- "$current")
    return
  fi
  if [[ $current == -* ]]; then
    case $command in
      detect)
        words='--margin --box --strategy --threads --verify --format -o --output --partial --data -h --help'
        ;;
      info) words='--partial --data -h --help' ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    return
  fi
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$current")
}

complete -F _allpairs allpairs
